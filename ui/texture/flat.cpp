// A region's surface as a still picture, to be painted on in another program.
#include <algorithm>

#include "ui/base/icons.h"
#include "ui/texture/parts.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

std::string stage_text(const FlattenView& now) {
    if (!now.stage) return "Starting…";
    const std::string frames =
        " " + std::to_string(now.done) + " of " + std::to_string(std::max(now.total, now.done));
    switch (*now.stage) {
        case WorkStage::kAnalyse:
            return "Analysing" + frames;
        case WorkStage::kWait:
            return "Taking the editor's analysis" + frames;
        default:
            return "Gathering the surface " + percent_text(now.done, std::max(now.total, 1));
    }
}

void progress(Ctx& c, const FlattenView& now) {
    const float share =
        now.total > 0 ? static_cast<float>(now.done) / static_cast<float>(now.total) : 0.0f;
    progress_bar(c, share, stage_text(now) + (now.left_s > 0 ? ", " + time_text(now.left_s) : ""));
    if (button(c, "Cancel##flat", {.icon = icons::kClose, .width = -1})) c.emit(StopPaintFlat{});
}

}  // namespace

void flat_controls(Ctx& c, const Region& region) {
    const auto& now = c.view.flattening;
    if (now && now->region == region.id) return progress(c, *now);
    const auto& programs = c.view.paint_programs;
    if (programs.empty()) {
        button(c, "Paint flat…",
               {.icon = icons::kBrush,
                .enabled = false,
                .tip = "Install Krita or GIMP, or name your paint program in the settings",
                .width = -1});
        return;
    }
    const std::string& name = programs.front().name;
    const bool shows_picture = !region.texture.plane.empty();
    const std::string label =
        (shows_picture ? "Open in " + name : "Paint flat in " + name + "…") + "##flat";
    if (button(c, label.c_str(),
               {.icon = icons::kBrush,
                .enabled = !now && c.view.plate.state == PlateView::State::kOpen,
                .tip = shows_picture
                           ? "What you save there shows here a second or two later"
                           : "Writes this surface as one still picture, without its light and "
                             "what passes in front, and opens it. A logo, dirt or a repair that "
                             "you paint on it and save lies on the surface in every frame",
                .width = -1}))
        c.emit(PaintFlat{region.id, programs.front().command});
    c.note("Paint flat");
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
