// Floating windows: command palette, shortcuts, settings, history.
#include <algorithm>
#include <cmath>

#include "engine/core/text.h"
#include "ui/floating_window.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/sheets.h"
#include "ui/widgets.h"

namespace weft::ui {
namespace {

// Score of a name for the typed text: all letters in order; beginnings of words count more.
int score(const std::string& name, const std::string& typed) {
    int total = 0;
    std::size_t at = 0;
    for (const char ch : typed) {
        if (ch == ' ') continue;
        const std::size_t found = name.find(ch, at);
        if (found == std::string::npos) return -1;
        total += found == 0 || name[found - 1] == ' ' ? 8 : found == at ? 4 : 1;
        at = found + 1;
    }
    return total * 16 - static_cast<int>(name.size()) / 4;
}

// "Set placement.rotate_deg of cloth" → "Rotate texture of cloth"; other settings by their labels.
std::string step_label(const std::string& step) {
    constexpr std::string_view kSet = "Set ", kOf = " of ";
    if (!step.starts_with(kSet) || step.starts_with("Set the ")) return step;
    const std::size_t of = step.find(kOf);
    const std::string key = step.substr(kSet.size(), of - kSet.size());
    const std::string rest = of == std::string::npos ? "" : step.substr(of + kOf.size());
    if (key == "placement.scale") return "Scale texture of " + rest;
    if (key == "placement.rotate_deg") return "Rotate texture of " + rest;
    if (key == "placement.offset_px") return "Move texture of " + rest;
    const std::string label = readable_label(key);
    return rest.empty() ? label : label + " of " + rest;
}

}  // namespace

void command_palette(Ctx& c) {
    if (!c.state.palette_open) return;
    const Theme& t = c.theme;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(t.px(560), screen.x - t.px(40));
    const std::string typed = lower_case(c.state.palette_text);
    std::vector<std::pair<int, const Command*>> found;
    for (const Command& command : c.commands.all()) {
        if (command.enabled && !command.enabled(c)) continue;
        const int points = score(lower_case(command.name + " " + command.category), typed);
        if (points >= 0) found.emplace_back(points, &command);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    constexpr int kRows = 10;
    const int rows = std::min(kRows, static_cast<int>(found.size()));
    ImGui::SetNextWindowFocus();
    begin_floating(t, "##palette", {std::floor((screen.x - width) / 2), t.px(90)},
                   {width, t.px(62) + t.px(30) * static_cast<float>(std::max(1, rows))},
                   {t.px(12), t.px(12)});
    const PanelName panel(c, "Palette");
    if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
    if (input(c, "Find a command", c.state.palette_text, "Type a command", -1, icons::kMagnify))
        c.state.palette_at = 0;
    if (ImGui::IsKeyPressed(264)) ++c.state.palette_at;
    if (ImGui::IsKeyPressed(265)) --c.state.palette_at;
    c.state.palette_at = std::clamp(c.state.palette_at, 0, std::max(0, rows - 1));
    const Command* chosen = nullptr;
    const int first = std::max(0, c.state.palette_at - kRows + 1);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    ImGui::Dummy({0, t.px(6)});
    for (int k = first; k < first + rows; ++k) {
        const Command& command = *found[static_cast<std::size_t>(k)].second;
        ImGui::PushID(k);
        if (ImGui::InvisibleButton("##command", {-FLT_MIN, t.px(30)})) chosen = &command;
        ImGui::PopID();
        c.note(command.name);
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (k == c.state.palette_at)
            list.AddRectFilled(min, max, faded(t.accent, 0.3f), t.radius);
        else if (ImGui::IsItemHovered())
            list.AddRectFilled(min, max, t.hover, t.radius);
        icon_in(c, list, {min.x + t.px(4), min.y}, {min.x + t.px(28), max.y}, t.quiet,
                command.icon);
        text_in(list, t.regular, {min.x + t.px(34), min.y}, max, t.text, command.name.c_str(), 0);
        const float w = ImGui::CalcTextSize(command.name.c_str()).x;
        text_in(list, t.small, {min.x + t.px(44) + w, min.y}, max, t.off, command.category.c_str(),
                0);
        text_in(list, t.small, min, {max.x - t.px(8), max.y}, t.quiet,
                chord_text(command.key).c_str(), 1);
    }
    ImGui::PopStyleVar();
    if (rows == 0) quiet(c, "No matching command");
    if (ImGui::IsKeyPressed(257) && rows > 0)
        chosen = found[static_cast<std::size_t>(c.state.palette_at)].second;
    const bool outside = ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered();
    ImGui::End();
    if (chosen || outside || ImGui::IsKeyPressed(256)) c.state.palette_open = false;
    if (chosen) chosen->run(c);
}

void history_window(Ctx& c) {
    if (!c.state.history_open) return;
    const Theme& t = c.theme;
    begin_sheet(c, "History", {t.px(380), t.px(480)}, c.state.history_open);
    ImGui::BeginChild("##history", {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, t.px(1)});
    for (std::size_t k = c.view.history.size(); k-- > 0;) {
        const std::string label = k == 0 ? "Opened" : step_label(c.view.history[k]);
        ImGui::PushID(static_cast<int>(k));
        if (ImGui::InvisibleButton("##step", {-FLT_MIN, t.row})) c.emit(GoToHistory{k});
        ImGui::PopID();
        c.note(label);
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const bool now = k == c.view.history_position, later = k > c.view.history_position;
        if (now)
            list.AddRectFilled(min, max, faded(t.accent, 0.3f), t.radius);
        else if (ImGui::IsItemHovered())
            list.AddRectFilled(min, max, t.hover, t.radius);
        text_in(list, t.regular, {min.x + t.px(10), min.y}, max, later ? t.off : t.text,
                fitted(label, max.x - min.x - t.px(20)).c_str(), 0);
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
    end_sheet(c);
}

void about_window(Ctx& c) {
    if (!c.state.about_open) return;
    const Theme& t = c.theme;
    begin_sheet(c, "About Weft", {t.px(420), t.px(230)}, c.state.about_open);
    wrapped(c,
            "Weft replaces textures in animation: mask a surface, choose a texture, and it "
            "stays on that surface through the whole shot, lit like the plate.",
            t.text);
    ImGui::Dummy({0, t.px(6)});
    wrapped(c, "Set in Inter, with Material Design Icons. The interface is drawn with Dear ImGui.",
            t.quiet);
    end_sheet(c);
}

void leave_question(Ctx& c) {
    if (!c.state.leave_asked) return;
    const auto go = [&] {
        c.state.leave_asked = c.state.leave_when_saved = false;
        const std::string then = c.state.leave_then;
        c.state.leave_then.clear();
        if (then.empty()) c.state.leave = true;
        if (then == "demo") c.emit(OpenDemo{});
        if (then == "new") c.emit(NewProject{});
        if (then == "close") c.emit(CloseProject{});
        if (then == "browse") c.state.browser.purpose = BrowserState::Purpose::kOpen;
        if (then.starts_with("/")) c.emit(OpenAny{then});
    };
    // Leave only after the save; if it failed, a notice says why and the document stays open.
    if (c.state.leave_when_saved) {
        if (c.view.saving) return;
        if (!c.view.modified) return go();
        c.state.leave_asked = c.state.leave_when_saved = false;
        c.state.leave_then.clear();
        return;
    }
    if (!c.view.modified && c.state.leave_then.empty()) {
        const bool rendering =
            std::any_of(c.view.jobs.begin(), c.view.jobs.end(), [](const JobView& j) {
                return j.state == JobState::kRunning || j.state == JobState::kPaused;
            });
        if (!rendering) {
            c.state.leave_asked = false;
            c.state.leave = true;
            return;
        }
    }
    const Theme& t = c.theme;
    bool open = true;
    const bool modified = c.view.modified;
    begin_sheet(c, modified ? "Save first?" : "A render is running", {t.px(440), t.px(190)}, open);
    wrapped(c,
            modified ? "'" + c.view.title + "' has changes that are not saved."
                     : "The render continues when the editor is closed; its frames are written "
                       "to its output folder.",
            t.text);
    ImGui::Dummy({0, t.px(12)});
    if (modified) {
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
        if (button(c, "Don't save")) go();
    } else {
        if (button(c, "Keep rendering", {.look = Look::kPrimary})) go();
        ImGui::SameLine();
        if (button(c, "Cancel render", {.look = Look::kDanger})) {
            for (const JobView& job : c.view.jobs)
                c.emit(CommandJob{job.id, JobCommand::kCancel});
            go();
        }
    }
    ImGui::SameLine();
    if (button(c, "Stay") || !open) {
        c.state.leave_asked = false;
        c.state.leave_then.clear();
    }
    end_sheet(c);
}

namespace {

// What the first step of the tour says of the shot that is open.
std::string words_of_shot(const Ctx& c) {
    const SessionView& v = c.view;
    if (v.plate.frames.empty()) return "Open a shot: a folder of frames, a movie or a project.";
    std::string text = "This shot has " + std::to_string(v.plate.frames.size()) + " frames";
    const auto& regions = v.project.regions;
    if (regions.empty())
        return text +
               " and no regions yet. A region is a surface that gets a new texture. Press Space to "
               "play the shot.";
    text += " and " + std::to_string(regions.size()) +
            (regions.size() == 1 ? " region, a surface that gets a new texture: "
                                 : " regions, surfaces that get new textures: ");
    constexpr std::size_t kNamed = 4;
    for (std::size_t k = 0; k < std::min(kNamed, regions.size()); ++k)
        text += (k ? ", " : "") + regions[k]->name;
    if (regions.size() > kNamed) text += ", …";
    return text + ". They are listed on the right. Press Space to play the shot.";
}

}  // namespace

void tour(Ctx& c) {
    struct Step {
        const char* title;
        std::string text;
        Workspace workspace;
    };
    const Step kSteps[] = {
        {"A shot and its regions", words_of_shot(c), Workspace::kMask},
        {"Masking a surface",
         "A matte defines where a surface is. Add a region with +, choose the brush (B) and paint "
         "over a surface on one frame; it is propagated to the others. Ctrl subtracts, [ and ] "
         "change the "
         "size.",
         Workspace::kMask},
        {"Choosing a texture",
         "Textures are below. Double-click one, or drag it onto a surface. Scale and rotation "
         "are on the right; R moves it on the picture.",
         Workspace::kTexture},
        {"Tracking",
         "The texture follows its surface. G draws a grid on it and S shows where it stretches. "
         "Where it slides, pin it or add a second reference frame.",
         Workspace::kMotion},
        {"Light and seams",
         "The plate's light is applied to the new texture. Lower its strength, or compare the four "
         "stages with 4. X shows the seams.",
         Workspace::kLight},
        {"Rendering",
         "Choose the frames and press the blue button. You can keep working meanwhile. Afterwards "
         "the Review workspace shows how stable the result is.",
         Workspace::kJobs}};
    constexpr int kCount = static_cast<int>(std::size(kSteps));
    int& step = c.state.tour_step;
    if (step < 0) return;
    if (step >= kCount) {
        step = -1;
        c.settings.tour_seen = true;
        return;
    }
    const Theme& t = c.theme;
    const Step& now = kSteps[step];
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = t.px(380);
    const ImVec2 text = ImGui::CalcTextSize(now.text.c_str(), nullptr, false, width - t.px(32));
    const float h = text.y + t.px(104);
    // Over the picture, above the panels below it; the render page has room on the right.
    const float body = screen.y - t.px(66);
    const float panel_h = c.state.workspace == Workspace::kTexture ? t.px(c.state.drawer_h)
                          : c.state.workspace == Workspace::kLight ? t.px(c.state.strip_h)
                                                                   : 0;
    const float most = (screen.y / t.scale < 800 ? 0.34f : 0.36f) * body;
    const bool jobs = c.state.workspace == Workspace::kJobs;
    const float foot = jobs ? t.px(26) : t.px(26 + 34) + t.px(c.state.timeline_h);
    begin_floating(t, "##tour",
                   {jobs ? screen.x - width - t.px(24) : t.px(64),
                    screen.y - h - foot - t.px(16) - std::min(panel_h, most)},
                   {width, h}, {t.px(16), t.px(14)}, ImGuiWindowFlags_NoFocusOnAppearing);
    const PanelName panel(c, "Tour");
    heading(c, now.title);
    wrapped(c, now.text, t.text);
    ImGui::SetCursorPosY(h - t.px(40));
    quiet(c, (std::to_string(step + 1) + " of " + std::to_string(kCount)).c_str());
    ImGui::SameLine(width - t.px(184));
    ImGui::SetCursorPosY(h - t.px(44));
    const int before = step;
    const bool escape = ImGui::IsKeyPressed(256) && !ImGui::GetIO().WantTextInput &&
                        ImGui::IsWindowFocused(ImGuiFocusedFlags_ChildWindows);
    if (button(c, "End", {.look = Look::kQuiet, .width = t.px(64)}) || escape) step = -1;
    ImGui::SameLine();
    if (button(c, before + 1 < kCount ? "Next" : "Done",
               {.look = Look::kPrimary, .width = t.px(88)}))
        ++step;
    ImGui::End();
    if (step != before && step >= 0 && step < kCount)
        set_workspace(c.state, kSteps[step].workspace);
    if (step == -1) c.settings.tour_seen = true;
}

}  // namespace weft::ui
