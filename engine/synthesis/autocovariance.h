#pragma once

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// Of the picture's luma less its mean a: Σ a(p)·a(p + d) over the number of pairs, for
/// |d.x| ≤ reach.x and 0 ≤ d.y ≤ reach.y, at (d.x + reach.x, d.y).
[[nodiscard]] Image<double, 1> autocovariance(ViewU8x3 picture, Vec2i reach);

}  // namespace weft
