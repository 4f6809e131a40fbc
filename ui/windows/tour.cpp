// The tour: a few steps through the workspaces.
#include <algorithm>

#include "ui/widgets/floating_window.h"
#include "ui/widgets/widgets.h"
#include "ui/windows/windows.h"

namespace weft::ui {
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
         "A matte defines where a surface is. Choose the brush (B) and paint over a surface on one "
         "frame; it is propagated to the others. Ctrl subtracts, [ and ] change the size. For "
         "another surface add a region with +.",
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
    const bool escape = ImGui::IsKeyPressed(256) && !ImGui::GetIO().WantTextInput;
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
