#pragma once
// Roto shapes as polygons and mattes, and the shapes in between.

#include <vector>

#include "engine/core/image.h"
#include "engine/mask/roto_shape.h"

namespace weft {

/// The curve as a polygon, `steps` a segment.
[[nodiscard]] std::vector<Vec2> outline_of(const RotoShape& shape, int steps = 16);
/// Coverage: 255 inside, falling off over the feather, its width blended between the points.
[[nodiscard]] Matte matte_of_shape(const RotoShape& shape, Size size);
/// Point by point; `t` 0 gives `a`. Both must have the same number of points, else `a` is given.
[[nodiscard]] RotoShape between(const RotoShape& a, const RotoShape& b, float t);
/// Gives points that were set as corners handles along their neighbours (Catmull and Rom).
[[nodiscard]] RotoShape smoothed(RotoShape shape);

}  // namespace weft
