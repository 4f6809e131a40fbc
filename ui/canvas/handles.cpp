#include "ui/canvas/handles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace weft::ui {

Grip handle(Ctx& c, const ViewMap& map, const std::string& id, Vec2& at, bool hovered, ImU32 color,
            bool filled) {
    UiState& s = c.state;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    Grip grip = Grip::kNone;
    if (s.handle_held == id) {
        at = map.to_plate(mouse) + s.handle_offset;
        grip = ImGui::IsMouseDown(0) ? Grip::kHeld : Grip::kLetGo;
        if (grip == Grip::kLetGo) s.handle_held.clear();
    } else {
        const ImVec2 here = map.to_screen(at);
        const bool near = hovered && std::hypot(here.x - mouse.x, here.y - mouse.y) < c.theme.px(9);
        if (near && s.handle_held.empty()) {
            grip = Grip::kNear;
            if (ImGui::IsMouseClicked(0)) {
                s.handle_held = id;
                s.handle_offset = at - map.to_plate(mouse);
                grip = Grip::kTaken;
            }
        }
    }
    const ImVec2 on = map.to_screen(at);
    const float r = c.theme.px(grip == Grip::kNone ? 4.5f : 6.0f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircleFilled(on, r + c.theme.px(1.5f), IM_COL32(0, 0, 0, 170), 20);
    if (filled)
        list.AddCircleFilled(on, r, color, 20);
    else
        list.AddCircle(on, r, color, 20, c.theme.px(1.5f));
    c.note("Handle " + id, {on.x - r, on.y - r}, {on.x + r, on.y + r});
    if (grip != Grip::kNone) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    return grip;
}

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

bool breaks_off() {
    const ImGuiIO& io = ImGui::GetIO();
    return io.KeyAlt || (io.KeyCtrl && io.KeyShift);
}

Vec2 arrow_step() {
    KeyChord pressed = pressed_chord(true);
    const float step = pressed.shift ? 10 : 1;
    pressed.shift = false;
    if (pressed == *parse_chord("Left")) return {-step, 0};
    if (pressed == *parse_chord("Right")) return {step, 0};
    if (pressed == *parse_chord("Up")) return {0, -step};
    if (pressed == *parse_chord("Down")) return {0, step};
    return {0, 0};
}

bool any_handle_held(const Ctx& c) {
    return !c.state.handle_held.empty();
}

bool keys_for_picture(const Ctx& c) {
    return !c.state.keys_taken && !ImGui::GetIO().WantTextInput;
}

bool take_back_drag(Ctx& c) {
    UiState& s = c.state;
    const bool transforms = s.transform.drag != TransformState::Drag::kNone;
    if (!any_handle_held(c) && !transforms && !s.warp.box_from && !s.brush.lassoing) return false;
    if (!keys_for_picture(c) || !ImGui::IsKeyPressed(256)) return false;
    s.handle_held.clear();
    s.transform.drag = TransformState::Drag::kNone;
    s.warp.before.reset();
    s.warp.box_from.reset();
    s.shape_box.from.reset();
    s.shape_box.scale = 1;
    s.shape_box.radians = 0;
    if (std::exchange(s.brush.lassoing, false)) s.brush.outline.clear();
    c.drop_tried();
    return true;
}

PixelAspect plate_aspect(const Ctx& c) {
    return PixelAspect(c.view.plate.pixel_aspect);
}

void plate_circle(Ctx& c, const ViewMap& map, Vec2 middle, float radius_px, ImU32 color,
                  float width) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const PixelAspect aspect = plate_aspect(c);
    const float r = radius_px * map.zoom;
    const int segments = std::clamp(static_cast<int>(r), 16, 96);
    const ImVec2 on = map.to_screen(middle);
    if (map.aspect == aspect.ratio()) return list.AddCircle(on, r, color, segments, width);
    std::vector<ImVec2> points;
    for (int k = 0; k < segments; ++k) {
        const float angle =
            2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(segments);
        const Vec2 way = radius_px * Vec2(std::cos(angle), std::sin(angle));
        points.push_back(map.to_screen(middle + aspect.squeezed(way)));
    }
    list.AddPolyline(points.data(), segments, color, ImDrawFlags_Closed, width);
}

void plate_line(Ctx& c, const ViewMap& map, Vec2 from, Vec2 to, ImU32 color) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine(map.to_screen(from), map.to_screen(to), IM_COL32(0, 0, 0, 160), c.theme.px(3));
    list.AddLine(map.to_screen(from), map.to_screen(to), color, c.theme.px(1.5f));
}

void quad_lines(Ctx& c, const ViewMap& map, const std::array<Vec2, 4>& at) {
    for (std::size_t k = 0; k < 4; ++k)
        plate_line(c, map, at[k], at[(k + 1) % 4], c.theme.accent_hover);
}

}  // namespace weft::ui
