// Notices over the picture: questions first, then messages, newest first.
#include <algorithm>
#include <cmath>
#include <string>

#include "ui/base/icons.h"
#include "ui/widgets/floating_window.h"
#include "ui/widgets/widgets.h"
#include "ui/windows/windows.h"

namespace weft::ui {
namespace {

// A stack of boxes; on the render page from the bottom up, clear of the queue.
class NoticeStack {
  public:
    explicit NoticeStack(Ctx& c)
        : c_(c),
          low_(c.view.open && c.state.workspace == Workspace::kJobs),
          width_(std::min(c.theme.px(440), ImGui::GetIO().DisplaySize.x - c.theme.px(40))) {
        const ImVec2 screen = ImGui::GetIO().DisplaySize;
        x_ = std::floor(low_ ? screen.x - width_ - c.theme.px(16) : (screen.x - width_) / 2);
        y_ = low_ ? screen.y - c.theme.px(26 + 12) : c.theme.px(52);
    }
    [[nodiscard]] float width() const { return width_; }

    /// `buttons(at, height)` draws into the box with corner `at`; `extra` pixels below the text are
    /// left for it.
    template <class Buttons>
    void add(const std::string& id, NoticeKind kind, const std::string& text, float extra,
             Buttons&& buttons) {
        const Theme& t = c_.theme;
        const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width_ - t.px(76));
        const float h = std::max(t.px(40), size.y + t.px(22)) + extra;
        if (low_) y_ -= h;
        begin_floating(t, id.c_str(), {x_, y_}, {width_, h}, {0, 0},
                       ImGuiWindowFlags_NoFocusOnAppearing);
        const ImVec2 at = ImGui::GetWindowPos();
        draw(kind, at, h - extra, h);
        ImGui::GetWindowDrawList()->AddText(
            t.regular, t.regular->FontSize,
            {at.x + t.px(40), at.y + std::floor((h - extra - size.y) / 2)}, t.text, text.c_str(),
            nullptr, width_ - t.px(76));
        buttons(at, h);
        ImGui::End();
        y_ += low_ ? -t.px(8) : h + t.px(8);
    }

    /// A box with two answers.
    template <class Answer>
    void ask(const std::string& id, const std::string& text, const char* yes, const char* icon,
             const char* no, Answer&& answer) {
        const Theme& t = c_.theme;
        add(id, NoticeKind::kWarning, text, t.px(36), [&](ImVec2 at, float h) {
            ImGui::SetCursorScreenPos({at.x + t.px(40), at.y + h - t.px(38)});
            if (button(c_, yes, {.icon = icon, .look = Look::kPrimary})) answer(true);
            ImGui::SameLine();
            if (button(c_, no)) answer(false);
        });
    }

  private:
    // The coloured bar and the icon of the kind; the icon is vertically centred on the text.
    void draw(NoticeKind kind, ImVec2 at, float text_height, float height) const {
        const Theme& t = c_.theme;
        const ImU32 color = kind == NoticeKind::kGood      ? t.good
                            : kind == NoticeKind::kWarning ? t.warn
                            : kind == NoticeKind::kError   ? t.bad
                                                           : t.accent;
        const char* icon = kind == NoticeKind::kGood   ? icons::kCheckCircle
                           : kind == NoticeKind::kInfo ? icons::kInformation
                                                       : icons::kAlert;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(at, {at.x + t.px(4), at.y + height}, color);
        icon_in(c_, list, {at.x + t.px(10), at.y}, {at.x + t.px(34), at.y + text_height}, color,
                icon);
    }

    Ctx& c_;
    bool low_;
    float width_, x_ = 0, y_ = 0;
};

void add_notice(Ctx& c, NoticeStack& stack, const Notice& notice) {
    const auto buttons = [&](ImVec2 at, float) {
        const Theme& t = c.theme;
        ImGui::SetCursorScreenPos({at.x + stack.width() - t.px(34), at.y + t.px(6)});
        if (icon_button(c, icons::kClose, "Dismiss", false, nullptr, true, t.px(26)) &&
            c.dismiss_notice)
            c.dismiss_notice(notice.id);
        if (notice.kind != NoticeKind::kError) return;
        if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(1))
            c.pictures.set_clipboard(notice.text);
        if (ImGui::IsWindowHovered() && !ImGui::IsAnyItemHovered())
            ImGui::SetTooltip("Right-click to copy this message");
    };
    stack.add("##notice" + std::to_string(notice.id), notice.kind, notice.text, 0, buttons);
}

// Names the first files; the rest are counted.
std::string missing_text(const std::vector<std::string>& missing) {
    constexpr std::size_t kNamed = 3;
    std::string text = missing.size() == 1
                           ? "A file of this project is missing:"
                           : std::to_string(missing.size()) + " files of this project are missing:";
    for (std::size_t k = 0; k < std::min(kNamed, missing.size()); ++k)
        text += "\n" + missing[k];
    if (missing.size() > kNamed)
        text += "\nand " + std::to_string(missing.size() - kNamed) + " more";
    return text;
}

void collecting(Ctx& c, NoticeStack& stack, const CollectView& now) {
    const Theme& t = c.theme;
    stack.add(
        "##collect", NoticeKind::kInfo, "Collecting files in " + now.folder, t.px(36),
        [&](ImVec2 at, float h) {
            const float bar = stack.width() - t.px(40 + 16 + 90);
            ImGui::SetCursorScreenPos({at.x + t.px(40), at.y + h - t.px(34)});
            progress_bar(
                c,
                now.total > 0 ? static_cast<float>(now.done) / static_cast<float>(now.total) : 0.0f,
                now.total > 0
                    ? std::to_string(now.done) + " of " + std::to_string(now.total) + " files"
                    : std::string("Counting files"),
                bar);
            ImGui::SetCursorScreenPos({at.x + stack.width() - t.px(16 + 80), at.y + h - t.px(38)});
            if (button(c, "Cancel", {.width = t.px(80)})) c.emit(CancelCollect{});
        });
}

}  // namespace

void notices(Ctx& c) {
    const PanelName panel(c, "Notices");
    NoticeStack stack(c);
    if (c.view.recovery)
        stack.ask("##recovery",
                  (c.view.recovery->project_path.empty() ? std::string("An unsaved project")
                                                         : c.view.recovery->project_path) +
                      " was not closed properly. Its autosave of " + c.view.recovery->when +
                      " can be recovered.",
                  "Recover", icons::kRestore, "Discard", [&](bool yes) { c.emit(Recover{yes}); });
    if (c.view.trust)
        stack.ask("##trust",
                  "This project writes to " + c.view.trust->output +
                      ", outside of its folder. Trust this folder?",
                  "Trust", icons::kCheckCircle, "Not now",
                  [&](bool yes) { c.emit(TrustFolder{yes}); });
    if (!c.view.missing.empty() && !c.state.missing_dismissed)
        stack.ask("##missing", missing_text(c.view.missing), "Relink…", icons::kFolderOpen,
                  "Not now", [&](bool yes) {
                      c.state.missing_dismissed = true;
                      if (yes) c.commands.run("file.relink", c);
                  });
    if (c.view.collecting) collecting(c, stack, *c.view.collecting);
    for (auto notice = c.view.notices.rbegin(); notice != c.view.notices.rend(); ++notice)
        add_notice(c, stack, *notice);
}

}  // namespace weft::ui
