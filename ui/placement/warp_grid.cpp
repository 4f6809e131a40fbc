#include "ui/placement/warp_grid.h"

#include <algorithm>

#include "engine/core/warp_net.h"

namespace weft::ui {
namespace {

// The points towards `wanted`, as far as the grid does not fold. On the way all numbers are linear,
// as between two keys.
GridWarp unfolded(const GridWarp& warp, int frame, const std::vector<WarpPoint>& now,
                  std::vector<WarpPoint> wanted) {
    const auto found = WarpNet(warp, now).unfolded_towards(WarpNet(warp, wanted));
    if (found.share >= 1) {
        GridWarp all = with_points(warp, frame, wanted);
        // Between two keys it may fold although neither does.
        return !all.moves() || check_grid_warp(all) ? all : warp;
    }
    constexpr int kSteps = 10'000;
    // A little less: at the fold itself nothing could be moved any more.
    const auto steps = static_cast<int>(0.99 * found.share * kSteps);
    GridWarp way = warp;
    way.keys = {{0, now}, {kSteps, std::move(wanted)}};
    GridWarp out = with_points(warp, frame, points_on(way, steps));
    return check_grid_warp(out) ? out : warp;
}

}  // namespace

std::optional<glm::dvec2>& warp_handle(WarpPoint& point, std::size_t side) {
    switch (side) {
        case 0:
            return point.left;
        case 1:
            return point.right;
        case 2:
            return point.up;
        default:
            return point.down;
    }
}

GridWarp laid_grid(const Quad<float>& corners) {
    Quad<double> exact;
    std::copy(corners.begin(), corners.end(), exact.begin());
    return grid_over(exact, 3, 3);
}

GridWarp with_points(GridWarp warp, int frame, std::vector<WarpPoint> points) {
    if (warp.moves())
        set_key(warp, frame, std::move(points));
    else
        warp.points = std::move(points);
    return warp;
}

GridWarp with_points_moved(const GridWarp& warp, int frame, const std::set<std::size_t>& points,
                           Vec2 by) {
    const std::vector<WarpPoint> now = points_on(warp, frame);
    std::vector<WarpPoint> wanted = now;
    for (const std::size_t k : points)
        if (k < wanted.size()) wanted[k].at += glm::dvec2(by);
    return unfolded(warp, frame, now, std::move(wanted));
}

GridWarp with_handle(const GridWarp& warp, int frame, std::size_t point, std::size_t side,
                     Vec2 offset, bool both) {
    const std::vector<WarpPoint> now = points_on(warp, frame);
    std::vector<WarpPoint> wanted = now;
    warp_handle(wanted[point], side) = glm::dvec2(offset);
    if (both) warp_handle(wanted[point], side ^ 1U) = -glm::dvec2(offset);
    return unfolded(warp, frame, now, std::move(wanted));
}

GridWarp with_smooth_points(const GridWarp& warp, int frame, const std::set<std::size_t>& points) {
    const std::vector<WarpPoint> now = points_on(warp, frame);
    std::vector<WarpPoint> wanted = now;
    for (const std::size_t k : points)
        if (k < wanted.size()) wanted[k] = {wanted[k].at, {}, {}, {}, {}};
    return unfolded(warp, frame, now, std::move(wanted));
}

Edit edit_of_warp(const Region& region, std::optional<GridWarp> warp) {
    SetRegionParameter edit{{region.id, {}}, "placement.warp", {}};
    if (warp) edit.value = std::move(*warp);
    return edit;
}

}  // namespace weft::ui
