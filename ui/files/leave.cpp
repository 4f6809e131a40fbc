// Leaving the document, and the question before it.
#include <algorithm>
#include <utility>

#include "ui/files/files.h"
#include "ui/widgets/sheet.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

namespace {

// Not one of another shot, whose window is another one.
bool own(const Ctx& c, const JobView& job) {
    return job.mine || job.plate == c.view.plate.path;
}

void leave_now(Ctx& c, const LeaveFor& what) {
    switch (what.kind) {
        case LeaveFor::Kind::kQuit:
            c.state.leave = true;
            break;
        case LeaveFor::Kind::kNew:
            c.emit(NewProject{});
            break;
        case LeaveFor::Kind::kDemo:
            c.emit(OpenDemo{});
            break;
        case LeaveFor::Kind::kBrowse:
            c.state.browser = {};
            c.state.browser.purpose = BrowserState::Purpose::kOpen;
            c.state.browser.just_opened = true;
            break;
        case LeaveFor::Kind::kClose:
            c.emit(CloseProject{});
            break;
        case LeaveFor::Kind::kPath:
            c.emit(OpenAny{what.path});
            break;
    }
}

// Something that this window has submitted is being rendered.
bool renders(const Ctx& c) {
    return std::any_of(c.view.jobs.begin(), c.view.jobs.end(), [&](const JobView& j) {
        return own(c, j) && (j.state == JobState::kRunning || j.state == JobState::kPaused);
    });
}

// What would end unfinished; empty: nothing.
std::string ends_with(const Ctx& c, const LeaveFor& what) {
    std::string text;
    if (c.view.flattening) {
        const Region* region = region_by_id(c.view.project, c.view.flattening->region);
        text = "The surface of '" + (region ? region->name : std::string()) +
               "' is still being gathered for painting. Leaving ends that, and nothing of it is "
               "kept.";
    }
    // Of another shot it goes on.
    if (c.view.collecting && what.kind == LeaveFor::Kind::kQuit)
        text += std::string(text.empty() ? "" : " ") +
                "Files are still being collected. Leaving ends that, and the copies are removed "
                "again.";
    return text;
}

// A dialog as tall as its text and a row of buttons, which follow.
void begin_question(Ctx& c, const char* title, const std::string& text, bool& open) {
    const Theme& t = c.theme;
    const float width = t.px(440), gap = t.px(12);
    const float text_h = ImGui::CalcTextSize(text.c_str(), nullptr, false, width - t.px(32)).y;
    const float spaces = 2 * ImGui::GetStyle().ItemSpacing.y + gap;
    begin_sheet(c, title, {width, t.px(50) + text_h + spaces + t.row + t.px(16)}, open);
    wrapped(c, text, t.text);
    ImGui::Dummy({0, gap});
}

// The answers to the questions return true if they mean to leave now.
bool save_answers(Ctx& c) {
    if (button(c, "Save", {.look = Look::kPrimary})) {
        if (c.view.path.empty()) {
            c.state.leave_asked = false;
            c.commands.run("file.save", c);
        } else {
            c.emit(Save{});
            c.state.leave_when_saved = true;
        }
    }
    ImGui::SameLine();
    return button(c, "Don't save");
}

bool render_answers(Ctx& c) {
    const bool keep = button(c, "Keep rendering", {.look = Look::kPrimary});
    ImGui::SameLine();
    if (!button(c, "Cancel render", {.look = Look::kDanger})) return keep;
    for (const JobView& job : c.view.jobs)
        if (own(c, job)) c.emit(CommandJob{job.id, JobCommand::kCancel});
    return true;
}

bool leave_answer(Ctx& c) {
    return button(c, "Leave", {.look = Look::kDanger});
}

}  // namespace

void leave_for(Ctx& c, const LeaveFor& what) {
    if (!c.view.modified && ends_with(c, what).empty()) return leave_now(c, what);
    c.state.leave_asked = true;
    c.state.leave_then = what;
}

void leave_question(Ctx& c) {
    if (!c.state.leave_asked) return;
    const auto go = [&] {
        c.state.leave_asked = c.state.leave_when_saved = false;
        leave_now(c, std::exchange(c.state.leave_then, {}));
    };
    // Leave only after the save; if it failed, a notice says why and the document stays open.
    if (c.state.leave_when_saved) {
        if (c.view.saving) return;
        if (!c.view.modified) return go();
        c.state.leave_asked = c.state.leave_when_saved = false;
        c.state.leave_then = {};
        return;
    }
    const bool modified = c.view.modified;
    const bool rendering = c.state.leave_then.kind == LeaveFor::Kind::kQuit && renders(c);
    const std::string ends = ends_with(c, c.state.leave_then);
    if (!modified && !rendering && ends.empty()) return go();
    bool open = true;
    const std::string more = ends.empty() ? ends : " " + ends;
    if (modified)
        begin_question(c, "Save first?",
                       "'" + c.view.title + "' has changes that are not saved." + more, open);
    else if (rendering)
        begin_question(c, "A render is running",
                       "The render continues when the editor is closed; its frames are written to "
                       "its output folder." +
                           more,
                       open);
    else
        begin_question(c, "Leave now?", ends, open);
    if (modified ? save_answers(c) : rendering ? render_answers(c) : leave_answer(c)) go();
    ImGui::SameLine();
    if (button(c, "Cancel") || !open) {
        c.state.leave_asked = false;
        c.state.leave_then = {};
    }
    end_sheet(c);
}

}  // namespace weft::ui
