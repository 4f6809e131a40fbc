#pragma once
// A grid warp: what an artist's grid of control points moves on the reference frame.

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/quad.h"

namespace weft {

/// A control point, in plate pixels. Handles are relative to it; one that is unset follows from the
/// neighbouring points as in a Catmull–Rom spline, so that the patches join smoothly.
struct WarpPoint {
    glm::dvec2 at{0, 0};
    std::optional<glm::dvec2> left, right, up, down;
    bool operator==(const WarpPoint&) const = default;
};

/// Columns × rows of patches between (columns + 1) × (rows + 1) control points. At rest the points
/// divide the quadrilateral `corners` evenly, seen in its perspective; what lies there comes to lie
/// where the points have been moved. Points are in rows from the top left.
struct GridWarp {
    int columns = 2, rows = 2;  ///< 1 to kMostPatches.
    Quad<double> corners = {};  ///< Convex; plate pixels.
    double falloff_px = 0;      ///< Beyond the border the warp fades over so far; 0: it continues.
    std::vector<WarpPoint> points = {};
    /// Points over time, in place of `points`: by frame, ascending, each frame once. Linear between
    /// two keys, constant outside of them.
    std::vector<std::pair<int, std::vector<WarpPoint>>> keys = {};

    static constexpr int kMostPatches = 16;
    static constexpr std::size_t kMostKeys = 1000;
    static constexpr double kMostPx = 1'000'000;

    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(columns + 1) * static_cast<std::size_t>(rows + 1);
    }
    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns + 1) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] bool moves() const { return !keys.empty(); }
    bool operator==(const GridWarp&) const = default;
};

/// A grid at rest over a quadrilateral.
[[nodiscard]] GridWarp grid_over(const Quad<double>& corners, int columns, int rows);

/// The points on a frame, those of the keys where there are any.
[[nodiscard]] std::vector<WarpPoint> points_on(const GridWarp& warp, int frame);
/// Adds a key or replaces the one on `frame`.
void set_key(GridWarp& warp, int frame, std::vector<WarpPoint> points);

/// Points with all four handles: those that are unset as they follow from the neighbours.
[[nodiscard]] std::vector<WarpPoint> with_handles(const GridWarp& warp,
                                                  const std::vector<WarpPoint>& points);

/// The same warp with another number of patches: every new point where the old warp moves it.
/// Handles that would not follow by themselves are set.
[[nodiscard]] GridWarp resampled(const GridWarp& warp, int columns, int rows);

/// The warp in a frame that is `factor` times smaller, factor > 0.
[[nodiscard]] GridWarp on_smaller_frame(GridWarp warp, double factor);

/// Whether the warp has its points, all numbers are finite and in range, and it folds nowhere, on
/// no key and between no two keys. Errors: Usage with what is wrong, where, and what to do.
[[nodiscard]] Status check_grid_warp(const GridWarp& warp);

/// Text such as "2x1 corners 0,0 640,0 640,360 0,360 falloff 40 points P P P P P P key 12 P …",
/// each P "x,y" or with handles "x,y:l-10,0:r10,0:u0,-9:d0,9". Errors: Usage with the place;
/// without check_grid_warp().
[[nodiscard]] Expected<GridWarp> parse_grid_warp(std::string_view text);
/// The text that parse_grid_warp() reads back to the same warp.
[[nodiscard]] std::string grid_warp_text(const GridWarp& warp);

}  // namespace weft
