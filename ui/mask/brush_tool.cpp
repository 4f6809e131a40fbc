// Painting mattes with the brush.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ui/canvas/handles.h"
#include "ui/mask/mask.h"

namespace weft::ui {
namespace {

Brush brush_now(const Ctx& c) {
    Brush brush = c.state.brush.brush;
    const bool erase = c.state.tool == Tool::kEraser;
    brush.subtract = erase != subtracts();
    return brush;
}

void brush_ring(Ctx& c, const ViewMap& map) {
    const Brush brush = brush_now(c);
    const float r = std::max(2.0f, brush.radius_px * map.zoom);
    const ImVec2 at = ImGui::GetIO().MousePos;
    const auto ring = [&](float radius, ImU32 color) {
        plate_circle(c, map, map.to_plate(at), radius / map.zoom, color, c.theme.px(1));
    };
    ring(r + 1, IM_COL32(0, 0, 0, 150));
    ring(r, brush.subtract ? c.theme.bad : IM_COL32(255, 255, 255, 230));
    const float core = r * brush.hardness;
    if (brush.hardness < 0.95f && core > 3) ring(core, IM_COL32(255, 255, 255, 80));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float k = c.theme.px(3);
    list.AddLine({at.x - k, at.y}, {at.x + k, at.y}, IM_COL32(255, 255, 255, 200));
    list.AddLine({at.x, at.y - k}, {at.x, at.y + k}, IM_COL32(255, 255, 255, 200));
    ImGui::SetMouseCursor(ImGuiMouseCursor_None);
}

}  // namespace

void brush_tool(Ctx& c, const ViewMap& map, bool hovered) {
    BrushState& b = c.state.brush;
    const ImGuiIO& io = ImGui::GetIO();
    if (hovered || b.painting) brush_ring(c, map);
    // Ctrl with the right button changes the brush size, as in other paint tools.
    if (hovered && io.KeyCtrl && ImGui::IsMouseDragging(1, 0))
        b.brush.radius_px =
            std::clamp(b.brush.radius_px + io.MouseDelta.x / map.zoom, kLeastBrush_px, 2000.0f);
}

void brush_input(Ctx& c, const ViewMap& map, bool active) {
    if (c.view.plate.size.empty()) return;
    if (!paints(c.state.tool)) return;
    BrushState& b = c.state.brush;
    const StrokeKind kind = c.state.tool == Tool::kConfirm ? StrokeKind::kConfirm
                            : c.settings.here_only         ? StrokeKind::kHere
                                                           : StrokeKind::kKeyframe;
    const ImGuiIO& io = ImGui::GetIO();
    const Vec2 at = map.to_plate(io.MousePos);
    const float pressure = c.state.pen_pressure.value_or(1.0f);
    std::vector<Action> strokes;
    if (!b.painting && active && ImGui::IsMouseClicked(0)) {
        b.painting = true;
        if (io.KeyShift && b.line_from) {
            strokes.emplace_back(BeginStroke{brush_now(c), *b.line_from, pressure, kind});
            strokes.emplace_back(ContinueStroke{at, pressure});
        } else {
            strokes.emplace_back(BeginStroke{brush_now(c), at, pressure, kind});
        }
    } else if (b.painting) {
        for (const Vec2 point : path_on_plate(c, map))
            strokes.emplace_back(ContinueStroke{point, pressure});
    }
    if (!strokes.empty()) c.emit_now(std::move(strokes));
    if (b.painting && !ImGui::IsMouseDown(0)) {
        b.painting = false;
        b.line_from = at;
        c.emit(EndStroke{});
    }
}

}  // namespace weft::ui
