#pragma once
#include "engine/form/metric_field.h"

namespace weft {

/// Adds the form that a position pass shows on the reference frame. `positions`: H×W×3 of its
/// size, in any one unit of length, in the world, the camera or the object; what is not finite is
/// unknown. `matte`: the visible surface; pixels under 255 are mixed and do not count. Steps of the
/// surface come from planes fitted to 5 × 5 px, without pixels across a fold or an edge of depth.
/// Grazing views count less, by their cosine. Thread-safe.
void add_positions(MetricField& field, ViewF3 positions, ViewU8x1 matte);

}  // namespace weft
