#pragma once
// Shapes of Bezier curves with a feather at every point, as rotoscoping draws them.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

struct RotoPoint {
    Vec2 at{0, 0};             ///< Pixels of the plate.
    Vec2 in{0, 0}, out{0, 0};  ///< Handles, from `at`; zero: a corner.
    /// How far outside of the curve the matte reaches zero, in unsqueezed pixels.
    float feather_px = 0;
    bool operator==(const RotoPoint&) const = default;
};

/// Closed; three points or more make an area.
struct RotoShape {
    std::vector<RotoPoint> points;
    bool operator==(const RotoShape&) const = default;
};

/// What of a track's motion a shape takes.
enum class ShapeFollow : std::uint8_t {
    kNone,
    kPosition,
    kSimilarity,  ///< Position, rotation and scale.
    kPlanar       ///< The perspective of the plane as well.
};

/// A shape over time. Between keys it moves along its track, and the rest of its change is
/// interpolated; with one key it only follows.
struct KeyedShape {
    std::map<int, RotoShape> keys;  ///< As drawn on these frames; all with as many points.
    ShapeFollow follow = ShapeFollow::kNone;
    std::string track;  ///< File of a planar or point track; empty only with kNone.
    [[nodiscard]] bool empty() const { return keys.empty(); }
    bool operator==(const KeyedShape&) const = default;
};

}  // namespace weft
