#pragma once
// The arithmetic of the grid warp tool: moving points and handles of a grid, without a fold.

#include <optional>
#include <set>

#include "app/project/edit.h"
#include "engine/core/geometry.h"

namespace weft::ui {

/// The handles of a point by number: left, right, up, down.
inline constexpr std::size_t kWarpHandles = 4;
[[nodiscard]] std::optional<glm::dvec2>& warp_handle(WarpPoint& point, std::size_t side);

/// A grid of 3 × 3 patches over four corners.
[[nodiscard]] GridWarp laid_grid(const Quad<float>& corners);

/// The grid with other points on a frame: in a key where it has keys.
[[nodiscard]] GridWarp with_points(GridWarp warp, int frame, std::vector<WarpPoint> points);

/// Points moved by `by` plate pixels of the reference frame; short of the place where the grid
/// would fold.
[[nodiscard]] GridWarp with_points_moved(const GridWarp& warp, int frame,
                                         const std::set<std::size_t>& points, Vec2 by);
/// A handle of a point at this offset from it; `both`: and the opposite one mirrored. Short of the
/// place where the grid would fold.
[[nodiscard]] GridWarp with_handle(const GridWarp& warp, int frame, std::size_t point,
                                   std::size_t side, Vec2 offset, bool both);
/// The points' handles as they follow from the neighbours.
[[nodiscard]] GridWarp with_smooth_points(const GridWarp& warp, int frame,
                                          const std::set<std::size_t>& points);

/// The edit that gives a region this grid; unset: none.
[[nodiscard]] Edit edit_of_warp(const Region& region, std::optional<GridWarp> warp);

}  // namespace weft::ui
