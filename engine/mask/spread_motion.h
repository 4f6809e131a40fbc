#pragma once
#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// Motion where it is known, carried on to where it is not: normalised convolution (Knutsson &
/// Westin 1993) at growing radii, up to 40 px of 854×480. A wider radius counts only where the
/// narrower ones have no data, `fallback` only where none has. `weight` (0 to 1, how far it is
/// known) has the size of `motion`; `unit_px`: a pixel of 854×480. Parallel over rows.
[[nodiscard]] ImageF2 spread_motion(ViewF2 motion, ViewF1 weight, Vec2 fallback, float unit_px);

}  // namespace weft
