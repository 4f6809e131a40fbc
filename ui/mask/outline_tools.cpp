// Outlines that are filled: the lasso and the polygon.
#include <cmath>
#include <vector>

#include "ui/canvas/handles.h"
#include "ui/canvas/snapping.h"
#include "ui/mask/mask.h"

namespace weft::ui {
namespace {

void draw_outline(Ctx& c, const ViewMap& map, const Vec2* rubber) {
    const std::vector<Vec2>& points = c.state.brush.outline;
    if (points.empty()) return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    std::vector<ImVec2> line;
    for (const Vec2 p : points)
        line.push_back(map.to_screen(p));
    if (rubber) line.push_back(map.to_screen(*rubber));
    const int count = static_cast<int>(line.size());
    list.AddPolyline(line.data(), count, IM_COL32(0, 0, 0, 180), 0, c.theme.px(3));
    list.AddPolyline(line.data(), count, c.theme.accent_hover, 0, c.theme.px(1.5f));
}

void finish_outline(Ctx& c) {
    BrushState& b = c.state.brush;
    if (b.outline.size() > 2)
        c.emit(FillPolygon{b.outline, b.outline_subtracts, c.settings.here_only});
    b.outline.clear();
    b.lassoing = false;
}

}  // namespace

void lasso_tool(Ctx& c, const ViewMap& map, bool active) {
    BrushState& b = c.state.brush;
    const Vec2 at = map.to_plate(ImGui::GetIO().MousePos);
    if (active && ImGui::IsMouseClicked(0)) {
        b.outline = {at};
        b.outline_subtracts = subtracts();
        b.lassoing = true;
    } else if (b.lassoing) {
        for (const Vec2 point : path_on_plate(c, map)) {
            const Vec2 step = point - b.outline.back();
            if (std::hypot(step.x, step.y) * map.zoom > 2) b.outline.push_back(point);
        }
        if (!ImGui::IsMouseDown(0)) finish_outline(c);
    }
    draw_outline(c, map, nullptr);
}

void polygon_tool(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    BrushState& b = c.state.brush;
    Vec2 at = map.to_plate(ImGui::GetIO().MousePos);
    // With the first point Ctrl subtracts.
    const bool snap = b.outline.empty() ? c.state.snap : snaps(c);
    if (hovered) at = snapped(c, map, at, snap);
    const bool closes = b.outline.size() > 2 && [&] {
        const ImVec2 first = map.to_screen(b.outline.front()), now = ImGui::GetIO().MousePos;
        return std::hypot(first.x - now.x, first.y - now.y) < c.theme.px(9);
    }();
    if (active && ImGui::IsMouseClicked(0)) {
        if (closes || (ImGui::IsMouseDoubleClicked(0) && b.outline.size() > 2))
            return finish_outline(c);
        // What counts is the modifier with which it began.
        if (b.outline.empty()) b.outline_subtracts = subtracts();
        b.outline.push_back(at);
    }
    if (!b.outline.empty() && keys_for_picture(c)) {
        if (ImGui::IsKeyPressed(257)) finish_outline(c);
        if (ImGui::IsKeyPressed(256)) b.outline.clear();
        if (ImGui::IsKeyPressed(259) && !b.outline.empty()) b.outline.pop_back();
    }
    draw_outline(c, map, hovered ? &at : nullptr);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const Vec2 p : b.outline)
        list.AddCircleFilled(map.to_screen(p), c.theme.px(3), c.theme.accent_hover, 12);
    if (closes)
        list.AddCircle(map.to_screen(b.outline.front()), c.theme.px(8), c.theme.accent_hover, 20,
                       c.theme.px(2));
}

}  // namespace weft::ui
