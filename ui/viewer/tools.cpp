// Gives the mouse to the tool in hand.

#include "ui/canvas/handles.h"
#include "ui/form/form.h"
#include "ui/light/light.h"
#include "ui/mask/mask.h"
#include "ui/motion/motion.h"
#include "ui/placement/placement.h"
#include "ui/texture/texture.h"
#include "ui/viewer/parts.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
void viewer_tools(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    if (c.view.plate.size.empty()) return;
    if (c.state.keep_overlay && c.state.tool != Tool::kKeep) {
        c.state.keep_overlay = false;
        if (c.view.overlay == Overlay::kSourceMap) c.emit(ShowOverlay{Overlay::kNone});
    }
    switch (c.state.tool) {
        case Tool::kPan:
            return;
        case Tool::kBrush:
        case Tool::kEraser:
        case Tool::kConfirm:
            return brush_tool(c, map, hovered);
        case Tool::kLasso:
            return lasso_tool(c, map, active);
        case Tool::kPolygon:
            return polygon_tool(c, map, hovered, active);
        case Tool::kFlood:
            if (active && ImGui::IsMouseClicked(0) && c.state.viewer.pixel)
                c.emit(FloodSelect{*c.state.viewer.pixel, c.state.brush.tolerance, subtracts(),
                                   c.settings.here_only});
            return;
        case Tool::kPlace:
            return transform_tool(c, map, hovered, active);
        case Tool::kWarp:
            return warp_tool(c, map, hovered, active);
        case Tool::kMeasure:
            return measure_tool(c, map, hovered, active);
        case Tool::kForm:
            return form_tool(c, map, hovered, active);
        case Tool::kShape:
            return shape_tool(c, map, hovered, active);
        case Tool::kScribble:
            return scribble_tool(c, map, active);
        case Tool::kSimilar:
            return similar_tool(c, map, active);
        case Tool::kPin:
            return pin_tool(c, map, hovered, active);
        case Tool::kLamp:
            return lamp_tool(c, map, hovered);
        case Tool::kKeep:
            return keep_tool(c, map, hovered, active);
        case Tool::kCrypto:
            if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
            if (active && ImGui::IsMouseClicked(0) && c.state.viewer.pixel)
                c.emit(PickCryptomatte{*c.state.viewer.pixel, subtracts()});
            return;
    }
}

void drop_texture(Ctx& c, const ViewMap& map, const std::string& path) {
    const Vec2 at = map.to_plate(ImGui::GetIO().MousePos);
    RegionId target = c.view.selected;
    // Find the topmost region with a matte under the mouse.
    for (const RegionMatteView& matte : c.view.mattes) {
        const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
        if (x < 0 || y < 0 || x >= matte.pixels.width() || y >= matte.pixels.height()) continue;
        if (matte.pixels.at(x, y) > 127) target = matte.region;
    }
    c.emit(ApplyTexture{path, target});
    if (target != c.view.selected) c.emit(SelectRegion{target});
}

}  // namespace weft::ui
