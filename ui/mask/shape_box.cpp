// The transform box of a roto shape: handles at its corners scale, the one above it rotates, both
// about a pivot.
#include "ui/mask/shape_box.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/canvas/handles.h"

namespace weft::ui {
namespace {

constexpr float kMargin = 14, kStem = 26;  // unscaled px on screen

Vec2 turned(Vec2 p, Vec2 pivot, float scale, float radians, PixelAspect aspect) {
    const Vec2 d = aspect.unsqueezed(p - pivot);
    const float co = scale * std::cos(radians), si = scale * std::sin(radians);
    return pivot + aspect.squeezed(Vec2(co * d.x - si * d.y, si * d.x + co * d.y));
}

Vec2 middle_of(const Quad<float>& box) {
    return 0.25f * (box[0] + box[1] + box[2] + box[3]);
}

// Even-odd, so that a shape that crosses itself is what its matte is.
bool is_inside(const std::vector<Vec2>& outline, Vec2 p) {
    bool inside = false;
    for (std::size_t k = 0, last = outline.size() - 1; k < outline.size(); last = k++) {
        const Vec2 a = outline[k], b = outline[last];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y))
            inside = !inside;
    }
    return inside;
}

}  // namespace

Quad<float> box_of_shape(const RotoShape& shape, float margin, PixelAspect aspect) {
    Vec2 low(1e9f), high(-1e9f);
    for (const Vec2 p : outline_of(shape)) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    low -= aspect.squeezed(Vec2(margin));
    high += aspect.squeezed(Vec2(margin));
    return {low, Vec2(high.x, low.y), high, Vec2(low.x, high.y)};
}

RotoShape turned_shape(RotoShape shape, Vec2 pivot, float scale, float radians,
                       PixelAspect aspect) {
    for (RotoPoint& p : shape.points) {
        p.at = turned(p.at, pivot, scale, radians, aspect);
        p.in = turned(p.in, {0, 0}, scale, radians, aspect);
        p.out = turned(p.out, {0, 0}, scale, radians, aspect);
        p.feather_px *= scale;
    }
    return shape;
}

bool shape_inside(Ctx& c, const ViewMap& map, bool active, bool hovered) {
    static constexpr const char* kId = "shape inside";
    UiState& s = c.state;
    const Vec2 mouse = map.to_plate(ImGui::GetIO().MousePos);
    if (s.handle_held == kId) {
        const Vec2 by = mouse - std::exchange(s.shape_box.inside_at, mouse);
        for (RotoPoint& point : s.shape.points)
            point.at += by;
        if (ImGui::IsMouseDown(0)) return false;
        s.handle_held.clear();
        return mouse != s.shape_box.start;
    }
    if (!hovered || any_handle_held(c) || !is_inside(outline_of(s.shape), mouse)) return false;
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
    if (!active || !ImGui::IsMouseClicked(0) || breaks_off()) return false;
    s.handle_held = kId;
    s.shape_box.start = s.shape_box.inside_at = mouse;
    return false;
}

bool shape_box(Ctx& c, const ViewMap& map, bool hovered, bool& over) {
    ShapeBoxState& s = c.state.shape_box;
    RotoShape& shape = c.state.shape;
    if (s.region != c.view.selected || s.frame != c.view.frame) {
        s = {};
        s.region = c.view.selected;
        s.frame = c.view.frame;
    }
    // Of the shape as it was when the drag began, turned with it.
    const RotoShape& from = s.from ? *s.from : shape;
    const PixelAspect aspect = plate_aspect(c);
    Quad<float> box = box_of_shape(from, c.theme.px(kMargin) / map.zoom, aspect);
    Vec2 pivot = s.pivot.value_or(middle_of(box));
    for (Vec2& corner : box)
        corner = turned(corner, pivot, s.scale, s.radians, aspect);
    quad_lines(c, map, box);
    const Vec2 top = 0.5f * (box[0] + box[1]);
    const Vec2 side = aspect.unsqueezed(box[0] - box[3]);
    const float length = std::max(1e-3f, std::hypot(side.x, side.y));
    Vec2 knob = top + aspect.squeezed(side * (c.theme.px(kStem) / map.zoom / length));
    ImGui::GetWindowDrawList()->AddLine(map.to_screen(top), map.to_screen(knob),
                                        c.theme.accent_hover, c.theme.px(1.5f));
    bool done = false;
    const auto drag = [&](const std::string& id, Vec2 at, bool turns) {
        const Vec2 start = at;
        const Grip grip = handle(c, map, id, at, hovered, c.theme.accent_hover, !turns);
        over |= grip != Grip::kNone;
        if (grip == Grip::kTaken) {
            s.from = shape;
            s.start = start;
        }
        if (!s.from || (grip != Grip::kHeld && grip != Grip::kLetGo)) return;
        const Vec2 a = aspect.unsqueezed(s.start - pivot), b = aspect.unsqueezed(at - pivot);
        constexpr float kLeast = 0.02f, kMost = 50;
        if (turns)
            s.radians = std::atan2(b.y, b.x) - std::atan2(a.y, a.x);
        else
            s.scale = std::clamp(std::hypot(b.x, b.y) / std::max(1.0f, std::hypot(a.x, a.y)),
                                 kLeast, kMost);
        shape = turned_shape(*s.from, pivot, s.scale, s.radians, aspect);
        if (grip != Grip::kLetGo) return;
        done = s.scale != 1 || s.radians != 0;
        s.from.reset();
        s.scale = 1;
        s.radians = 0;
    };
    for (std::size_t k = 0; k < box.size(); ++k)
        drag("shape scale " + std::to_string(k + 1), box[k], false);
    drag("shape rotate", knob, true);
    const Grip grip = handle(c, map, "shape pivot", pivot, hovered, c.theme.warn, false);
    over |= grip != Grip::kNone;
    if (grip == Grip::kHeld || grip == Grip::kLetGo) s.pivot = pivot;
    return done;
}

}  // namespace weft::ui
