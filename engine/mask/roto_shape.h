#pragma once
// Shapes of Bezier curves with a feather at every point, as rotoscoping draws them.

#include <vector>

#include "engine/core/geometry.h"

namespace weft {

struct RotoPoint {
    Vec2 at{0, 0};             ///< Pixels of the plate.
    Vec2 in{0, 0}, out{0, 0};  ///< Handles, from `at`; zero: a corner.
    float feather_px = 0;      ///< How far outside of the curve the matte reaches zero.
    bool operator==(const RotoPoint&) const = default;
};

/// Closed; three points or more make an area.
struct RotoShape {
    std::vector<RotoPoint> points;
    bool operator==(const RotoShape&) const = default;
};

}  // namespace weft
