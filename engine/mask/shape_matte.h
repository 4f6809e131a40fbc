#pragma once
// Roto shapes as polygons and mattes, and interpolation between shapes.

#include <vector>

#include "engine/core/image.h"
#include "engine/core/pixel_aspect.h"
#include "engine/mask/roto_shape.h"

namespace weft {

/// Samples the curve as a polygon with `steps` points per segment.
[[nodiscard]] std::vector<Vec2> outline_of(const RotoShape& shape, int steps = 16);
/// The inside of a closed polygon (even-odd rule), anti-aliased; empty of less than three points.
[[nodiscard]] Matte polygon_matte(const std::vector<Vec2>& points, Size size);
/// Rasterizes the shape: 255 inside, falling to 0 over the feather, whose width is interpolated
/// between points and the same in all directions of the picture unsqueezed.
[[nodiscard]] Matte matte_of_shape(const RotoShape& shape, Size size, PixelAspect aspect = {});
/// Interpolates point by point; `t` 0 gives `a`. Returns `a` if the numbers of points differ.
[[nodiscard]] RotoShape between(const RotoShape& a, const RotoShape& b, float t);
/// Gives corner points smooth handles (Catmull–Rom).
[[nodiscard]] RotoShape smoothed(RotoShape shape);

}  // namespace weft
