#include "engine/core/grid_warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/warp_net.h"

namespace weft {
namespace {

using glm::dvec2;
using Handle = std::optional<dvec2>;

constexpr std::array<Handle WarpPoint::*, 4> kHandles{&WarpPoint::left, &WarpPoint::right,
                                                      &WarpPoint::up, &WarpPoint::down};

WarpPoint handled(const WarpNet& net, dvec2 grid) {
    const WarpNet::OnGrid on = net.on_grid(grid);
    const dvec2 across = on.by_column / 3.0, along = on.by_row / 3.0;
    return {on.at, -across, across, -along, along};
}

template <class Visit>
void for_points(const GridWarp& warp, const Visit& visit) {
    for (int j = 0; j <= warp.rows; ++j)
        for (int i = 0; i <= warp.columns; ++i)
            visit(warp.index(i, j), dvec2(i, j));
}

bool is_usable(dvec2 p) {
    return std::abs(p.x) <= GridWarp::kMostPx && std::abs(p.y) <= GridWarp::kMostPx;
}

Status check_points(const GridWarp& warp, const std::vector<WarpPoint>& points,
                    const std::string& where) {
    if (points.size() != warp.count()) {
        return fail(ErrorCode::kUsage,
                    fmt::format("a grid of {} × {} patches has {} points, not {}{}", warp.columns,
                                warp.rows, warp.count(), points.size(), where),
                    "give as many");
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
        bool fits = is_usable(points[k].at);
        for (const auto handle : kHandles)
            fits = fits && is_usable((points[k].*handle).value_or(dvec2(0, 0)));
        if (fits) continue;
        return fail(ErrorCode::kUsage,
                    fmt::format("point {}{} is farther away than {} px, or not a number", k + 1,
                                where, GridWarp::kMostPx),
                    "move it onto the plate");
    }
    return {};
}

Status folds(const GridWarp& warp, dvec2 grid, const std::string& where) {
    const auto patch = [](double along, int patches) {
        return std::min(static_cast<int>(along), patches - 1) + 1;
    };
    return fail(ErrorCode::kUsage,
                fmt::format("the grid folds at column {}, row {}{}", patch(grid.x, warp.columns),
                            patch(grid.y, warp.rows), where),
                std::string("move the points or handles around it apart") +
                    (warp.falloff_px > 0 ? ", or raise the fall-off" : ""));
}

Status check_folds(const GridWarp& warp) {
    const WarpNet still(warp, warp.points);
    if (const auto found = still.unfolded_towards(still); found.share < 1)
        return folds(warp, found.grid, "");
    for (std::size_t k = 0; k < warp.keys.size(); ++k) {
        const WarpNet at(warp, warp.keys[k].second);
        if (const auto found = at.unfolded_towards(at); found.share < 1)
            return folds(warp, found.grid, fmt::format(" on frame {}", warp.keys[k].first));
        if (k + 1 == warp.keys.size()) break;
        const WarpNet next(warp, warp.keys[k + 1].second);
        // That the next key folds by itself is said by its own turn.
        if (next.unfolded_towards(next).share < 1) continue;
        if (const auto found = at.unfolded_towards(next); found.share < 1)
            return folds(warp, found.grid,
                         fmt::format(" between frames {} and {}", warp.keys[k].first,
                                     warp.keys[k + 1].first));
    }
    return {};
}

}  // namespace

GridWarp grid_over(const Quad<double>& corners, int columns, int rows) {
    GridWarp warp{columns, rows, corners};
    warp.points.resize(warp.count());
    const WarpNet net(warp, warp.points);
    for_points(warp, [&](std::size_t k, dvec2 grid) { warp.points[k].at = net.rest(grid); });
    return warp;
}

std::vector<WarpPoint> points_on(const GridWarp& warp, int frame) {
    if (warp.keys.empty()) return warp.points;
    const auto after = std::find_if(warp.keys.begin(), warp.keys.end(),
                                    [&](const auto& key) { return key.first >= frame; });
    if (after == warp.keys.end()) return warp.keys.back().second;
    if (after == warp.keys.begin() || after->first == frame) return after->second;
    const auto before = after - 1;
    const double t = static_cast<double>(frame - before->first) /
                     (static_cast<double>(after->first) - before->first);
    std::vector<WarpPoint> out = before->second;
    const std::vector<WarpPoint> a = with_handles(warp, before->second);
    const std::vector<WarpPoint> b = with_handles(warp, after->second);
    for (std::size_t k = 0; k < out.size(); ++k) {
        out[k].at = glm::mix(a[k].at, b[k].at, t);
        for (const auto handle : kHandles)
            if (out[k].*handle || after->second[k].*handle)
                out[k].*handle = glm::mix(*(a[k].*handle), *(b[k].*handle), t);
    }
    return out;
}

void set_key(GridWarp& warp, int frame, std::vector<WarpPoint> points) {
    const auto at = std::find_if(warp.keys.begin(), warp.keys.end(),
                                 [&](const auto& key) { return key.first >= frame; });
    if (at != warp.keys.end() && at->first == frame)
        at->second = std::move(points);
    else
        warp.keys.insert(at, {frame, std::move(points)});
}

std::vector<WarpPoint> with_handles(const GridWarp& warp, const std::vector<WarpPoint>& points) {
    std::vector<WarpPoint> bare = points;
    for (WarpPoint& point : bare)
        for (const auto handle : kHandles)
            (point.*handle).reset();
    const WarpNet net(warp, bare);
    std::vector<WarpPoint> out = points;
    for_points(warp, [&](std::size_t k, dvec2 grid) {
        const WarpPoint derived = handled(net, grid);
        for (const auto handle : kHandles)
            if (!(out[k].*handle)) out[k].*handle = derived.*handle;
    });
    return out;
}

GridWarp resampled(const GridWarp& warp, int columns, int rows) {
    GridWarp out{columns, rows, warp.corners, warp.falloff_px};
    const dvec2 share(static_cast<double>(warp.columns) / columns,
                      static_cast<double>(warp.rows) / rows);
    const auto points = [&](const std::vector<WarpPoint>& from) {
        const WarpNet net(warp, from);
        std::vector<WarpPoint> wanted(out.count()), plain(out.count());
        for_points(out, [&](std::size_t k, dvec2 grid) {
            wanted[k] = handled(net, grid * share);
            for (const auto handle : {&WarpPoint::left, &WarpPoint::right})
                wanted[k].*handle = *(wanted[k].*handle) * share.x;
            for (const auto handle : {&WarpPoint::up, &WarpPoint::down})
                wanted[k].*handle = *(wanted[k].*handle) * share.y;
            plain[k].at = wanted[k].at;
        });
        constexpr double kSamePx = 0.25;
        const std::vector<WarpPoint> derived = with_handles(out, plain);
        for (std::size_t k = 0; k < plain.size(); ++k)
            for (const auto handle : kHandles)
                if (glm::distance(*(wanted[k].*handle), *(derived[k].*handle)) > kSamePx)
                    plain[k].*handle = wanted[k].*handle;
        return plain;
    };
    out.points = points(warp.points);
    for (const auto& [frame, key] : warp.keys)
        out.keys.emplace_back(frame, points(key));
    return out;
}

GridWarp on_smaller_frame(GridWarp warp, double factor) {
    for (dvec2& corner : warp.corners)
        corner /= factor;
    warp.falloff_px /= factor;
    const auto shrink = [&](std::vector<WarpPoint>& points) {
        for (WarpPoint& point : points) {
            point.at /= factor;
            for (const auto handle : kHandles)
                if (point.*handle) *(point.*handle) /= factor;
        }
    };
    shrink(warp.points);
    for (auto& [frame, points] : warp.keys)
        shrink(points);
    return warp;
}

Status check_grid_warp(const GridWarp& warp) {
    const auto patches = [](int n) { return n >= 1 && n <= GridWarp::kMostPatches; };
    if (!patches(warp.columns) || !patches(warp.rows)) {
        return fail(ErrorCode::kUsage,
                    fmt::format("a grid has 1 to {} columns and rows, not {} × {}",
                                GridWarp::kMostPatches, warp.columns, warp.rows));
    }
    if (!(warp.falloff_px >= 0 && warp.falloff_px <= GridWarp::kMostPx)) {
        return fail(ErrorCode::kUsage, fmt::format("the fall-off must be 0 to {} px, not {}",
                                                   GridWarp::kMostPx, warp.falloff_px));
    }
    if (!std::all_of(warp.corners.begin(), warp.corners.end(), is_usable) ||
        !is_convex<double>(warp.corners)) {
        return fail(ErrorCode::kUsage,
                    "the corners of the grid do not go around a convex quadrilateral",
                    "give top left, top right, bottom right, bottom left");
    }
    if (warp.keys.size() > GridWarp::kMostKeys)
        return fail(ErrorCode::kUsage,
                    fmt::format("it has more than {} keys", GridWarp::kMostKeys));
    WEFT_CHECK_OK(check_points(warp, warp.points, ""));
    for (std::size_t k = 0; k < warp.keys.size(); ++k) {
        const auto& [frame, points] = warp.keys[k];
        if (k > 0 && warp.keys[k - 1].first >= frame)
            return fail(ErrorCode::kUsage,
                        fmt::format("frame {} has two keys, or they are not in order", frame));
        WEFT_CHECK_OK(check_points(warp, points, fmt::format(" on frame {}", frame)));
    }
    return check_folds(warp);
}

}  // namespace weft
