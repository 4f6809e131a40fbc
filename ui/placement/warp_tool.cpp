// Tool that drags the points and handles of a grid warp, shown where this frame has carried them.
#include <algorithm>
#include <cmath>

#include "engine/core/warp_net.h"
#include "ui/canvas/handles.h"
#include "ui/canvas/snapping.h"
#include "ui/form/form.h"
#include "ui/placement/placement.h"
#include "ui/placement/transform_box.h"
#include "ui/placement/warp_grid.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

constexpr std::array<const char*, kWarpHandles> kSides{"left", "right", "up", "down"};

Vec2 float_of(glm::dvec2 p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

// Follows region and frame; forgets what belongs to another one.
void follow(Ctx& c, const Region& region) {
    WarpToolState& s = c.state.warp;
    if (s.region != region.id || s.frame != c.view.frame) {
        const bool same = s.region == region.id;
        std::set<std::size_t> selected = same ? std::move(s.selected) : std::set<std::size_t>();
        std::optional<GridWarp> proposed = same ? std::move(s.proposed) : std::nullopt;
        s = {};
        s.region = region.id;
        s.frame = c.view.frame;
        s.selected = std::move(selected);
        s.proposed = std::move(proposed);
    }
    if (s.before) return;
    const auto known = c.view.stages.places.find(region.id);
    if (known != c.view.stages.places.end()) s.places = known->second;
    const auto grid = warp_shown(c, region);
    if (grid) std::erase_if(s.selected, [&](std::size_t k) { return k >= grid->count(); });
}

Vec2 on_frame(const Ctx& c, Vec2 reference) {
    const auto& places = c.state.warp.places;
    return places ? places->frame(reference) : reference;
}
Vec2 on_reference(const Ctx& c, Vec2 plate) {
    const auto& places = c.state.warp.places;
    return places ? places->reference(plate) : plate;
}

// Whether this frame's places are known: on the reference frame they are its own.
bool is_placed(const Ctx& c, const Region& region) {
    const auto reference = reference_of(c, region);
    return c.state.warp.places || !reference || *reference == c.view.frame;
}

void draw_warp_curve(Ctx& c, const std::vector<ImVec2>& points) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const int count = static_cast<int>(points.size());
    list.AddPolyline(points.data(), count, IM_COL32(0, 0, 0, 150), 0, c.theme.px(3));
    list.AddPolyline(points.data(), count, c.theme.accent_hover, 0, c.theme.px(1.25f));
}

void draw_warp_grid(Ctx& c, const ViewMap& map, const GridWarp& warp) {
    const WarpNet net(warp, points_on(warp, c.view.frame));
    // Many patches are small ones.
    const int steps = std::clamp(64 / std::max(warp.columns, warp.rows), 4, 16);
    const auto curve = [&](glm::dvec2 from, glm::dvec2 way, int patches) {
        std::vector<ImVec2> points;
        for (int k = 0; k <= steps * patches; ++k) {
            const auto at = net.on_grid(from + way * (static_cast<double>(k) / steps)).at;
            points.push_back(map.to_screen(on_frame(c, float_of(at))));
        }
        draw_warp_curve(c, points);
    };
    for (int j = 0; j <= warp.rows; ++j)
        curve({0, j}, {1, 0}, warp.columns);
    for (int i = 0; i <= warp.columns; ++i)
        curve({i, 0}, {0, 1}, warp.rows);
}

void show(Ctx& c, const Region& region, GridWarp warp, Grip grip) {
    if (grip == Grip::kLetGo) {
        c.state.warp.before.reset();
        c.emit(DoEdits{{edit_of_warp(region, std::move(warp))}, "Warp texture"});
    } else {
        c.emit(TryEdits{{edit_of_warp(region, std::move(warp))}});
    }
}

// A click takes a point, Shift adds it to the others or takes it away.
void select(Ctx& c, std::size_t point) {
    std::set<std::size_t>& selected = c.state.warp.selected;
    if (!ImGui::GetIO().KeyShift) {
        if (!selected.contains(point)) selected = {point};
    } else if (selected.contains(point) && selected.size() > 1) {
        selected.erase(point);
    } else {
        selected.insert(point);
    }
}

// Handles of the selected points. Both of an axis move together, unless they are broken.
bool drag_handles(Ctx& c, const ViewMap& map, const Region& region, const GridWarp& warp,
                  bool hovered) {
    WarpToolState& s = c.state.warp;
    const std::vector<WarpPoint> points = with_handles(warp, points_on(warp, c.view.frame));
    bool over = false;
    for (const std::size_t k : s.selected) {
        WarpPoint point = points[k];
        const int column = static_cast<int>(k) % (warp.columns + 1);
        const int row = static_cast<int>(k) / (warp.columns + 1);
        const std::array<bool, kWarpHandles> there{column > 0, column<warp.columns, row> 0,
                                                   row < warp.rows};
        for (std::size_t side = 0; side < kWarpHandles; ++side) {
            if (!there[side]) continue;
            const glm::dvec2 offset = *warp_handle(point, side);
            Vec2 end = on_frame(c, float_of(point.at + offset));
            ImGui::GetWindowDrawList()->AddLine(map.to_screen(on_frame(c, float_of(point.at))),
                                                map.to_screen(end), faded(c.theme.text, 0.7f),
                                                c.theme.px(1));
            const Grip grip = handle(c, map, "warp " + std::to_string(k + 1) + " " + kSides[side],
                                     end, hovered, c.theme.text, false);
            over |= grip != Grip::kNone;
            if (grip == Grip::kTaken) s.before = warp;
            if ((grip != Grip::kHeld && grip != Grip::kLetGo) || !s.before) continue;
            const Vec2 to = on_reference(c, end) - float_of(point.at);
            show(c, region, with_handle(*s.before, c.view.frame, k, side, to, !breaks_off()), grip);
        }
    }
    return over;
}

bool drag_points(Ctx& c, const ViewMap& map, const Region& region, const GridWarp& warp,
                 bool hovered) {
    WarpToolState& s = c.state.warp;
    const std::vector<WarpPoint> points = points_on(warp, c.view.frame);
    bool over = false;
    for (std::size_t k = 0; k < points.size(); ++k) {
        Vec2 at = on_frame(c, float_of(points[k].at));
        const bool selected = s.selected.contains(k);
        const Grip grip = handle(c, map, "warp " + std::to_string(k + 1), at, hovered,
                                 selected ? c.theme.warn : c.theme.accent_hover, true);
        over |= grip != Grip::kNone;
        if (grip == Grip::kTaken) {
            select(c, k);
            s.before = warp;
        }
        if ((grip != Grip::kHeld && grip != Grip::kLetGo) || !s.before) continue;
        const Vec2 from = float_of(points_on(*s.before, c.view.frame)[k].at);
        const Vec2 shown = on_frame(c, from);
        const ImVec2 a = map.to_screen(shown), b = map.to_screen(at);
        // A click takes the point and moves nothing.
        const bool still = std::hypot(a.x - b.x, a.y - b.y) < c.theme.px(2);
        if (still && grip == Grip::kLetGo) {
            s.before.reset();
            c.emit(TryEdits{});
            continue;
        }
        if (still) continue;
        const Vec2 by = on_reference(c, snapped(c, map, at, snaps(c))) - on_reference(c, shown);
        show(c, region, with_points_moved(*s.before, c.view.frame, s.selected, by), grip);
    }
    return over;
}

// A drag on the picture selects what is inside of its box.
void select_box(Ctx& c, const ViewMap& map, const GridWarp& warp) {
    WarpToolState& s = c.state.warp;
    const ImVec2 mouse = ImGui::GetIO().MousePos, from = map.to_screen(*s.box_from);
    const ImVec2 low(std::min(mouse.x, from.x), std::min(mouse.y, from.y));
    const ImVec2 high(std::max(mouse.x, from.x), std::max(mouse.y, from.y));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, high, faded(c.theme.accent, 0.15f));
    list.AddRect(low, high, c.theme.accent_hover, 0, 0, c.theme.px(1));
    if (ImGui::IsMouseDown(0)) return;
    s.box_from.reset();
    if (!ImGui::GetIO().KeyShift) s.selected.clear();
    const std::vector<WarpPoint> points = points_on(warp, c.view.frame);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const ImVec2 at = map.to_screen(on_frame(c, float_of(points[k].at)));
        if (at.x >= low.x && at.x <= high.x && at.y >= low.y && at.y <= high.y)
            s.selected.insert(k);
    }
}

}  // namespace

std::optional<GridWarp> warp_shown(Ctx& c, const Region& region) {
    if (region.placement.warp) return region.placement.warp;
    WarpToolState& s = c.state.warp;
    if (region.placement.corners_px) {
        Quad<float> corners;
        for (std::size_t k = 0; k < 4; ++k)
            corners[k] = float_of(
                {(*region.placement.corners_px)[k].x, (*region.placement.corners_px)[k].y});
        return laid_grid(corners);
    }
    if (s.proposed) return s.proposed;
    for (const RegionMatteView& matte : c.view.mattes) {
        if (matte.region != region.id || matte.pixels.empty()) continue;
        const auto box = box_around(matte.pixels, 0);
        if (!box) continue;
        // Upright on the reference frame, whatever frame this is.
        Vec2 low(1e9f), high(-1e9f);
        for (const Vec2 corner : *box) {
            const Vec2 at = on_reference(c, corner);
            low = {std::min(low.x, at.x), std::min(low.y, at.y)};
            high = {std::max(high.x, at.x), std::max(high.y, at.y)};
        }
        if (high.x - low.x < 4 || high.y - low.y < 4) continue;
        s.proposed = laid_grid({low, Vec2(high.x, low.y), high, Vec2(low.x, high.y)});
        return s.proposed;
    }
    return std::nullopt;
}

bool nudge_warp(Ctx& c) {
    const Region* region = c.view.selected_region();
    const ImGuiIO& io = ImGui::GetIO();
    if (c.state.tool != Tool::kWarp || !region || io.WantTextInput) return false;
    const WarpToolState& s = c.state.warp;
    const Vec2 by = arrow_step();
    if (s.selected.empty() || s.region != region->id || by == Vec2{0, 0}) return false;
    const auto warp = warp_shown(c, *region);
    if (!warp) return false;
    const Vec2 at = on_frame(
        c,
        float_of(
            points_on(*warp, c.view.frame)[std::min(*s.selected.begin(), warp->count() - 1)].at));
    const Vec2 step = on_reference(c, at + by) - on_reference(c, at);
    c.emit(
        DoEdits{{edit_of_warp(*region, with_points_moved(*warp, c.view.frame, s.selected, step))},
                "Warp texture"});
    return true;
}

void warp_tool(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    const Region* region = c.view.selected_region();
    if (!region) return;
    if (!any_handle_held(c)) c.state.warp.before.reset();
    follow(c, *region);
    if (!is_placed(c, *region)) return;
    const auto warp = warp_shown(c, *region);
    if (!warp) return;
    WarpToolState& s = c.state.warp;
    draw_warp_grid(c, map, *warp);
    if (s.box_from) return select_box(c, map, *warp);
    const bool on_handle = drag_handles(c, map, *region, *warp, hovered);
    const bool on_point = drag_points(c, map, *region, *warp, hovered && !on_handle);
    if (on_handle || on_point || any_handle_held(c) || !active || !ImGui::IsMouseClicked(0)) return;
    s.box_from = map.to_plate(ImGui::GetIO().MousePos);
}

}  // namespace weft::ui
