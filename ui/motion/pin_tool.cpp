// Pins, which hold the texture in place.
#include <vector>

#include "ui/canvas/handles.h"
#include "ui/motion/motion.h"

namespace weft::ui {
namespace {

PlatePoint plate_point(Vec2 p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y)};
}
Vec2 place_of(PlatePoint p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

}  // namespace

// A click pins the texture in place; a drag moves it to where it belongs.
void pin_tool(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    const Region* region = c.view.selected_region();
    if (!region) return;
    const int frame = c.view.frame;
    const RegionRef ref{region->id, {}};
    if (!any_handle_held(c)) {
        const auto found = region->corrections.find(frame);
        c.state.pins =
            found == region->corrections.end() ? std::vector<CorrectionPin>{} : found->second;
    }
    std::vector<CorrectionPin>& pins = c.state.pins;
    bool over = false;
    for (std::size_t k = 0; k < pins.size(); ++k) {
        Vec2 to = place_of(pins[k].to);
        if (!(pins[k].from == pins[k].to))
            plate_line(c, map, place_of(pins[k].from), to, c.theme.accent_hover);
        const Grip grip = handle(c, map, "pin " + std::to_string(k + 1), to, hovered,
                                 c.theme.accent_hover, !(pins[k].from == pins[k].to));
        over |= grip != Grip::kNone;
        if (grip == Grip::kTaken && subtracts()) {
            c.state.handle_held.clear();
            pins.erase(pins.begin() + static_cast<std::ptrdiff_t>(k));
            c.edit(SetCorrection{ref, frame, pins});
            return;
        }
        if (grip != Grip::kHeld && grip != Grip::kLetGo) continue;
        pins[k].to = plate_point(to);
        if (grip == Grip::kLetGo)
            c.edit(SetCorrection{ref, frame, pins});
        else
            c.emit(TryEdit{SetCorrection{ref, frame, pins}});
    }
    if (over || !active || !ImGui::IsMouseClicked(0) || any_handle_held(c)) return;
    const Vec2 at = map.to_plate(ImGui::GetIO().MousePos);
    pins.push_back({plate_point(at), plate_point(at)});
    c.state.handle_held = "pin " + std::to_string(pins.size());
    c.state.handle_offset = {0, 0};
    c.emit(TryEdit{SetCorrection{ref, frame, pins}});
}

}  // namespace weft::ui
