#pragma once
// Shapes of Bezier curves with a feather at every point, as rotoscoping draws them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

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

/// The curve as a polygon, `steps` a segment.
[[nodiscard]] std::vector<Vec2> outline_of(const RotoShape& shape, int steps = 16);
/// Coverage: 255 inside, falling off over the feather, its width blended between the points.
[[nodiscard]] Matte matte_of_shape(const RotoShape& shape, Size size);
/// Point by point; `t` 0 gives `a`. Both must have the same number of points, else `a` is given.
[[nodiscard]] RotoShape between(const RotoShape& a, const RotoShape& b, float t);
/// Gives points that were set as corners handles along their neighbours (Catmull and Rom).
[[nodiscard]] RotoShape smoothed(RotoShape shape);

/// As JSON, for a matte keyframe's extra key "shape".
[[nodiscard]] std::string shape_text(const RotoShape& shape);
/// Nothing where it is no shape.
[[nodiscard]] std::optional<RotoShape> parse_shape(std::string_view text);

}  // namespace weft
