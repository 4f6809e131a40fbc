// Tool that transforms the texture: a box around the region with handles and a pivot, or the
// corners of a corner pin.
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/canvas/angles.h"
#include "ui/canvas/handles.h"
#include "ui/canvas/snapping.h"
#include "ui/placement/placement.h"
#include "ui/placement/transform_box.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

const RegionMatteView* matte_view(const Ctx& c) {
    for (const RegionMatteView& matte : c.view.mattes)
        if (matte.region == c.view.selected && !matte.pixels.empty()) return &matte;
    return nullptr;
}

// Where the placement acts for a place of this frame, unsqueezed; the place itself while that is
// not known.
Vec2 ground(const Ctx& c, Vec2 plate) {
    const auto& places = c.state.transform.places;
    return places ? places->at(plate) : plate_aspect(c).unsqueezed(plate);
}

// Where two lines through a and b meet, each with a direction; nothing where they are parallel.
std::optional<Vec2> meeting(Vec2 a, Vec2 along, Vec2 b, Vec2 other) {
    const float det = along.x * other.y - along.y * other.x;
    if (std::abs(det) < 1e-3f * std::hypot(along.x, along.y) * std::hypot(other.x, other.y))
        return std::nullopt;
    const Vec2 d = b - a;
    return a + along * ((d.x * other.y - d.y * other.x) / det);
}

// A dragged corner: where the two sides that end in it lie on edges of the plate, on their meeting;
// where one does, on that edge; else on the edge or corner of the plate that is nearest.
Vec2 snapped_corner(Ctx& c, const ViewMap& map, const std::array<Vec2, 4>& at, std::size_t k) {
    if (!snaps(c)) return at[k];
    const auto before = snapped_segment(c, map, at[(k + 3) % 4], at[k]);
    const auto after = snapped_segment(c, map, at[(k + 1) % 4], at[k]);
    if (before && after) {
        const auto both = meeting(before->first, before->second - before->first, after->first,
                                  after->second - after->first);
        const Vec2 d = both.value_or(at[k]) - at[k];
        constexpr float kReach = 16;  // screen px: two edges, each within its own reach
        if (both && std::hypot(d.x, d.y) * map.zoom < c.theme.px(kReach)) return *both;
    }
    if (before) return before->second;
    if (after) return after->second;
    return snapped(c, map, at[k], true);
}

// Handles of a corner pin.
bool place_corners(Ctx& c, const ViewMap& map, const Region& region, bool hovered) {
    if (!region.placement.corners_px) return false;
    static constexpr const char* kNames[] = {"corner 1", "corner 2", "corner 3", "corner 4"};
    std::array<Vec2, 4> at;
    for (std::size_t k = 0; k < 4; ++k) {
        const PlatePoint& p = (*region.placement.corners_px)[k];
        at[k] = {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
    quad_lines(c, map, at);
    bool taken = false, held = false, done = false;
    for (std::size_t k = 0; k < 4; ++k) {
        const Grip grip = handle(c, map, kNames[k], at[k], hovered, c.theme.accent_hover);
        taken |= grip != Grip::kNone;
        held |= grip == Grip::kHeld;
        done |= grip == Grip::kLetGo;
        if (grip == Grip::kHeld || grip == Grip::kLetGo) at[k] = snapped_corner(c, map, at, k);
    }
    const SetRegionParameter set{{region.id, {}}, "placement.corners_px", numbers_of(at)};
    if (done)
        c.edit(set);
    else if (held)
        c.emit(TryEdit{set});
    return taken;
}

// The surface and the box of the matte on this frame, renewed when they change, but not during a
// drag.
void follow_region(Ctx& c, const Region& region) {
    TransformState& s = c.state.transform;
    if (s.region != region.id || s.frame != c.view.frame) {
        s = {};
        s.region = region.id;
        s.frame = c.view.frame;
    }
    if (s.drag != TransformState::Drag::kNone) return;
    const auto known = c.view.stages.places.find(region.id);
    if (known != c.view.stages.places.end()) s.places = known->second;
    const RegionMatteView* matte = matte_view(c);
    if (!matte) {
        s.box.reset();
        return;
    }
    const double angle = placement_on(region.placement, c.view.frame).rotate_deg;
    if (s.box && s.box_version == matte->version && s.box_angle == angle) return;
    s.box = box_around(matte->pixels, angle, plate_aspect(c));
    s.box_version = matte->version;
    s.box_angle = angle;
}

Vec2 pivot_of(const Ctx& c) {
    const TransformState& s = c.state.transform;
    if (s.pivot) return *s.pivot;
    if (s.box) return 0.25f * ((*s.box)[0] + (*s.box)[1] + (*s.box)[2] + (*s.box)[3]);
    const Size plate = c.view.plate.size;
    return {static_cast<float>(plate.width) / 2, static_cast<float>(plate.height) / 2};
}

// What the drag does so far, from the mouse then and now as seen from the pivot, unsqueezed.
PlacementNumbers dragged_unsqueezed(const Ctx& c, Vec2 mouse) {
    const TransformState& s = c.state.transform;
    const PlacementNumbers from = unsqueezed(s.from, plate_aspect(c));
    const Vec2 pivot = ground(c, pivot_of(c));
    const Vec2 before = ground(c, s.mouse), now = ground(c, mouse);
    const Vec2 a = before - pivot, b = now - pivot;
    switch (s.drag) {
        case TransformState::Drag::kMove: {
            PlacementNumbers out = from;
            out.x += static_cast<double>(now.x - before.x);
            out.y += static_cast<double>(now.y - before.y);
            return out;
        }
        case TransformState::Drag::kScale: {
            const float reach = std::max(1.0f, std::hypot(a.x, a.y));
            return scaled_about(from, pivot, static_cast<double>(std::hypot(b.x, b.y) / reach));
        }
        case TransformState::Drag::kRotate: {
            const float turn = std::atan2(a.y, a.x) - std::atan2(b.y, b.x);
            return turned_about(from, pivot, static_cast<double>(turn) / kDegree);
        }
        case TransformState::Drag::kNone:
            break;
    }
    return from;
}

PlacementNumbers dragged(const Ctx& c, Vec2 mouse) {
    return squeezed(dragged_unsqueezed(c, mouse), plate_aspect(c));
}

// The box as the drag has moved it.
Quad<float> dragged_box(const Ctx& c, const PlacementNumbers& now, Vec2 mouse) {
    const TransformState& s = c.state.transform;
    Quad<float> out = *s.box;
    const PixelAspect aspect = plate_aspect(c);
    const Vec2 pivot = pivot_of(c);
    const double by = now.scale / s.from.scale;
    const double angle = (now.rotate_deg - s.from.rotate_deg) * kDegree;
    const auto cosine = static_cast<float>(by * std::cos(angle));
    const auto sine = static_cast<float>(by * std::sin(angle));
    for (Vec2& corner : out) {
        if (s.drag == TransformState::Drag::kMove) {
            corner += mouse - s.mouse;
        } else if (s.drag != TransformState::Drag::kNone) {
            const Vec2 d = aspect.unsqueezed(corner - pivot);
            const Vec2 now_at(cosine * d.x + sine * d.y, cosine * d.y - sine * d.x);
            corner = pivot + aspect.squeezed(now_at);
        }
    }
    return out;
}

bool is_in_box(const Quad<float>& box, Vec2 p) {
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 side = box[(k + 1) % 4] - box[k], d = p - box[k];
        if (side.x * d.y - side.y * d.x < 0) return false;
    }
    return true;
}

const char* label_of(TransformState::Drag drag) {
    switch (drag) {
        case TransformState::Drag::kScale:
            return "Scale texture";
        case TransformState::Drag::kRotate:
            return "Rotate texture";
        default:
            return "Move texture";
    }
}

void emit_edits(Ctx& c, std::vector<Edit> edits, const char* label) {
    if (edits.size() == 1)
        c.edit(edits.front());
    else if (!edits.empty())
        c.emit(DoEdits{std::move(edits), label});
}

// The numbers that the document has without the drag.
Region without_drag(const Ctx& c, const Region& region) {
    Region out = region;
    const PlacementNumbers& from = c.state.transform.from;
    if (out.placement.scale_keys.empty()) out.placement.scale = from.scale;
    if (out.placement.rotate_keys.empty()) out.placement.rotate_deg = from.rotate_deg;
    if (out.placement.offset_keys.empty()) out.placement.offset_px = {from.x, from.y};
    const auto put = [&](KeyedNumbers& keys, std::vector<double> numbers) {
        if (!keys.empty()) keys.set(c.view.frame, std::move(numbers));
    };
    put(out.placement.scale_keys, {from.scale});
    put(out.placement.rotate_keys, {from.rotate_deg});
    put(out.placement.offset_keys, {from.x, from.y});
    return out;
}

void go_on_with_drag(Ctx& c, const Region& region, Vec2 mouse) {
    TransformState& s = c.state.transform;
    const Region before = without_drag(c, region);
    std::vector<Edit> edits = edits_of_placement(before, c.view.frame, dragged(c, mouse));
    if (ImGui::IsMouseDown(0)) {
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        // None where the mouse is back at the start, so that nothing tried stays.
        if (moved.x != 0 || moved.y != 0) c.emit(TryEdits{std::move(edits)});
        return;
    }
    const char* label = label_of(s.drag);
    s.drag = TransformState::Drag::kNone;
    emit_edits(c, std::move(edits), label);
}

void begin(Ctx& c, const Region& region, TransformState::Drag drag, Vec2 mouse) {
    TransformState& s = c.state.transform;
    s.drag = drag;
    s.mouse = mouse;
    s.from = placement_on(region.placement, c.view.frame);
}

// The pivot: a ring with a cross. Returns true while the mouse has it.
bool pivot_handle(Ctx& c, const ViewMap& map, bool hovered) {
    TransformState& s = c.state.transform;
    Vec2 at = pivot_of(c);
    const ImVec2 on = map.to_screen(at);
    const float r = c.theme.px(9);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const auto& [color, width] :
         {std::pair{IM_COL32(0, 0, 0, 160), 3.0f}, std::pair{c.theme.accent_hover, 1.5f}}) {
        list.AddLine({on.x - r, on.y}, {on.x + r, on.y}, color, c.theme.px(width));
        list.AddLine({on.x, on.y - r}, {on.x, on.y + r}, color, c.theme.px(width));
    }
    const Grip grip = handle(c, map, "pivot", at, hovered, c.theme.accent_hover, false);
    if (grip == Grip::kHeld || grip == Grip::kLetGo) s.pivot = at;
    return grip != Grip::kNone;
}

}  // namespace

std::vector<double> numbers_of(const std::array<Vec2, 4>& corners) {
    constexpr double kPerPixel = 100;
    const auto rounded = [](float v) {
        return std::round(static_cast<double>(v) * kPerPixel) / kPerPixel;
    };
    std::vector<double> out;
    for (const Vec2 corner : corners) {
        out.push_back(rounded(corner.x));
        out.push_back(rounded(corner.y));
    }
    return out;
}

std::optional<std::array<Vec2, 4>> corners_around_region(Ctx& c) {
    const Region* region = c.view.selected_region();
    const RegionMatteView* matte = matte_view(c);
    if (!region || !matte) return std::nullopt;
    follow_region(c, *region);
    auto box = box_around(matte->pixels, 0);
    if (!box) return std::nullopt;
    for (Vec2& corner : *box)
        corner = plate_aspect(c).squeezed(ground(c, corner));
    return box;
}

bool nudge_texture(Ctx& c) {
    const Region* region = c.view.selected_region();
    const ImGuiIO& io = ImGui::GetIO();
    if (c.state.tool != Tool::kPlace || !region || io.WantTextInput) return false;
    const Vec2 by = arrow_step();
    if (by == Vec2{0, 0}) return false;
    follow_region(c, *region);
    const Vec2 at = pivot_of(c);
    const Vec2 d = plate_aspect(c).squeezed(ground(c, at + by) - ground(c, at));
    PlacementNumbers to = placement_on(region->placement, c.view.frame);
    to.x += static_cast<double>(d.x);
    to.y += static_cast<double>(d.y);
    emit_edits(c, edits_of_placement(*region, c.view.frame, to), "Move texture");
    return true;
}

void transform_tool(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    const Region* region = c.view.selected_region();
    if (!region) return;
    TransformState& s = c.state.transform;
    follow_region(c, *region);
    const bool pinned = region->placement.corners_px.has_value();
    if (s.drag == TransformState::Drag::kNone && place_corners(c, map, *region, hovered)) return;
    const Vec2 mouse = map.to_plate(ImGui::GetIO().MousePos);
    const bool on_pivot = pivot_handle(c, map, hovered && s.drag == TransformState::Drag::kNone);
    std::optional<Quad<float>> box;
    if (s.box && !pinned) {
        box = dragged_box(c, dragged(c, mouse), mouse);
        quad_lines(c, map, *box);
        for (std::size_t k = 0; k < 4; ++k) {
            Vec2 at = (*box)[k];
            const Grip grip =
                handle(c, map, "box " + std::to_string(k + 1), at, hovered, c.theme.accent_hover);
            if (grip == Grip::kTaken) begin(c, *region, TransformState::Drag::kScale, mouse);
        }
    }
    if (s.drag != TransformState::Drag::kNone) return go_on_with_drag(c, *region, mouse);
    if (on_pivot || any_handle_held(c)) return;
    const bool outside = box && !is_in_box(*box, mouse);
    if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
    if (!active || !ImGui::IsMouseClicked(0)) return;
    const ImGuiIO& io = ImGui::GetIO();
    begin(c, *region,
          io.KeyCtrl               ? TransformState::Drag::kScale
          : io.KeyShift || outside ? TransformState::Drag::kRotate
                                   : TransformState::Drag::kMove,
          mouse);
}

}  // namespace weft::ui
