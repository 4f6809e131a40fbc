// Painting, shapes and transforms with the mouse.
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels.h"
#include "ui/viewer.h"
#include "ui/viewer_handles.h"
#include "ui/widgets.h"

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
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const int segments = std::clamp(static_cast<int>(r), 16, 96);
    list.AddCircle(at, r + 1, IM_COL32(0, 0, 0, 150), segments, c.theme.px(1));
    list.AddCircle(at, r, brush.subtract ? c.theme.bad : IM_COL32(255, 255, 255, 230), segments,
                   c.theme.px(1));
    const float core = r * brush.hardness;
    if (brush.hardness < 0.95f && core > 3)
        list.AddCircle(at, core, IM_COL32(255, 255, 255, 80), segments, c.theme.px(1));
    const float k = c.theme.px(3);
    list.AddLine({at.x - k, at.y}, {at.x + k, at.y}, IM_COL32(255, 255, 255, 200));
    list.AddLine({at.x, at.y - k}, {at.x, at.y + k}, IM_COL32(255, 255, 255, 200));
    ImGui::SetMouseCursor(ImGuiMouseCursor_None);
}

void paint(Ctx& c, const ViewMap& map, bool hovered) {
    BrushState& b = c.state.brush;
    const ImGuiIO& io = ImGui::GetIO();
    if (hovered || b.painting) brush_ring(c, map);
    // Ctrl with the right button changes the brush size, as in other paint tools.
    if (hovered && io.KeyCtrl && ImGui::IsMouseDragging(1, 0))
        b.brush.radius_px =
            std::clamp(b.brush.radius_px + io.MouseDelta.x / map.zoom, 0.5f, 2000.0f);
}

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
    if (b.outline.size() > 2) c.emit(FillPolygon{b.outline, b.outline_subtracts, b.here_only});
    b.outline.clear();
    b.lassoing = false;
}

void lasso(Ctx& c, const ViewMap& map, bool active) {
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

void polygon(Ctx& c, const ViewMap& map, bool hovered, bool active) {
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
    if (!b.outline.empty() && !ImGui::GetIO().WantTextInput) {
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

// The reference line: its length in repeats sets the scale.
void measure(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    UiState& s = c.state;
    if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    bool over = false;
    if (s.measured) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImVec2 a = map.to_screen(s.measured->first), b = map.to_screen(s.measured->second);
        list.AddLine(a, b, IM_COL32(0, 0, 0, 170), c.theme.px(4));
        list.AddLine(a, b, c.theme.accent_hover, c.theme.px(2));
        // A tick at every repeat.
        const float dx = b.x - a.x, dy = b.y - a.y, length = std::max(1.0f, std::hypot(dx, dy));
        const ImVec2 across(-dy / length * c.theme.px(5), dx / length * c.theme.px(5));
        for (int k = 1; k < s.measured_count && s.measured_count <= 60; ++k) {
            const float u = static_cast<float>(k) / static_cast<float>(s.measured_count);
            const ImVec2 p(a.x + u * dx, a.y + u * dy);
            list.AddLine({p.x - across.x, p.y - across.y}, {p.x + across.x, p.y + across.y},
                         c.theme.accent_hover, c.theme.px(1.5f));
        }
        over |= handle(c, map, "line start", s.measured->first, hovered, c.theme.accent_hover) !=
                Grip::kNone;
        over |= handle(c, map, "line end", s.measured->second, hovered, c.theme.accent_hover) !=
                Grip::kNone;
    }
    if (over || any_handle_held(c) || !active || !ImGui::IsMouseClicked(0)) return;
    const Vec2 at = map.to_plate(ImGui::GetIO().MousePos);
    s.measured = {at, at};
    s.handle_held = "line end";
    s.handle_offset = {0, 0};
}

}  // namespace

bool subtracts() {
    const ImGuiIO& io = ImGui::GetIO();
    return io.KeyAlt || io.KeyCtrl;
}

std::vector<Vec2> path_on_plate(const Ctx& c, const ViewMap& map) {
    std::vector<Vec2> out;
    for (const ImVec2 at : c.state.mouse_path)
        out.push_back(map.to_plate(at));
    const ImGuiIO& io = ImGui::GetIO();
    if (out.empty() && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0))
        out.push_back(map.to_plate(io.MousePos));
    return out;
}

void brush_input(Ctx& c, const ViewMap& map, bool active) {
    if (c.view.plate.size.empty()) return;
    if (!paints(c.state.tool)) return;
    BrushState& b = c.state.brush;
    const StrokeKind kind = c.state.tool == Tool::kConfirm ? StrokeKind::kConfirm
                            : b.here_only                  ? StrokeKind::kHere
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
            return paint(c, map, hovered);
        case Tool::kLasso:
            return lasso(c, map, active);
        case Tool::kPolygon:
            return polygon(c, map, hovered, active);
        case Tool::kFlood:
            if (active && ImGui::IsMouseClicked(0) && c.state.viewer.pixel)
                c.emit(FloodSelect{*c.state.viewer.pixel, c.state.brush.tolerance, subtracts(),
                                   c.state.brush.here_only});
            return;
        case Tool::kPlace:
            return transform_tool(c, map, hovered, active);
        case Tool::kWarp:
            return warp_tool(c, map, hovered, active);
        case Tool::kMeasure:
            return measure(c, map, hovered, active);
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
