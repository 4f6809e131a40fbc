// A region's surface as a still picture, to be painted on in another program.
#include <algorithm>

#include "ui/base/icons.h"
#include "ui/texture/parts.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

std::string stage_text(const FlattenView& now) {
    if (!now.stage) return "Starting…";
    const std::string what = *now.stage == WorkStage::kAnalyse ? "Analysing "
                             : *now.stage == WorkStage::kWait  ? "Taking the editor's analysis "
                                                               : "Gathering the surface ";
    const std::string left = now.left_s > 0 ? ", " + time_text(now.left_s) + " left" : "";
    return what + percent_text(now.done, std::max(now.total, 1)) + left;
}

// As high as the button in whose place it is, so that nothing moves when it is over.
void progress(Ctx& c, const FlattenView& now) {
    const Theme& t = c.theme;
    const float share =
        now.total > 0 ? static_cast<float>(now.done) / static_cast<float>(now.total) : 0.0f;
    progress_bar(c, share, stage_text(now), ImGui::GetContentRegionAvail().x - t.row - t.px(4),
                 t.row);
    ImGui::SameLine(0, t.px(4));
    if (icon_button(c, icons::kClose, "Cancel gathering", false, nullptr, true, t.row))
        c.emit(StopPaintFlat{});
}

// Writes a picture of the surface, or opens the one that it shows.
void paint_button(Ctx& c, const Region& region, const PaintProgram& program) {
    const bool shows_picture = !region.texture.plane.empty();
    const std::string label =
        (shows_picture ? "Open in " + program.name : "Paint flat in " + program.name + "…") +
        "##flat";
    if (button(c, label.c_str(),
               {.icon = icons::kBrush,
                .enabled = !c.view.flattening && c.view.plate.state == PlateView::State::kOpen,
                .tip = shows_picture
                           ? "What you save there shows here a second or two later"
                           : "Writes this surface as one still picture, without its light and "
                             "what passes in front, and opens it. A logo, dirt or a repair that "
                             "you paint on it and save lies on the surface in every frame",
                .width = -1}))
        c.emit(PaintFlat{region.id, program.command});
    c.note("Paint flat");
}

}  // namespace

void flat_controls(Ctx& c, const Region& region) {
    const auto& programs = c.view.paint_programs;
    if (programs.empty()) {
        button(c, "Paint flat…",
               {.icon = icons::kBrush,
                .enabled = false,
                .tip = "Install Krita or GIMP, or name your paint program in the settings",
                .width = -1});
        return;
    }
    if (c.view.flattening && c.view.flattening->region == region.id)
        progress(c, *c.view.flattening);
    else
        paint_button(c, region, programs.front());
    if (programs.size() < 2) return;
    std::vector<std::string> names;
    names.reserve(programs.size());
    for (const PaintProgram& one : programs)
        names.push_back(one.name);
    int chosen = 0;
    if (choice(c, "Paint program", names, chosen, "The program in which the picture is opened"))
        c.settings.paint_program = programs[static_cast<std::size_t>(chosen)].command;
}

}  // namespace weft::ui
