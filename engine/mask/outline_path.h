#pragma once
// A closed outline by the length along it.

#include <cstddef>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

/// A closed polygon of three points or more. Places on it are lengths from its first point, px;
/// they go round: any number is a place. Const access is thread-safe.
class OutlinePath {
  public:
    explicit OutlinePath(std::vector<Vec2> points);

    [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }
    [[nodiscard]] double length() const { return from_.back(); }
    /// The length to a point of points().
    [[nodiscard]] double place_of(std::size_t point) const { return from_[point]; }
    [[nodiscard]] Vec2 at(double place) const;
    /// Which way it goes on (`side` 1) or comes from (−1) within `reach_px` of a place; length 1,
    /// or 0 where it comes back to itself.
    [[nodiscard]] Vec2 direction(double place, int side, double reach_px) const;

    struct Nearest {
        double place = 0;
        float distance_px = 0;  ///< Infinite: there is none.
    };
    /// The nearest place of the parts that go roughly `along` (a direction; zero: of all).
    [[nodiscard]] Nearest nearest(Vec2 p, Vec2 along = Vec2(0.0f)) const;

  private:
    std::vector<Vec2> points_;
    std::vector<double> from_;  // the length to each point, and last the whole
};

}  // namespace weft
