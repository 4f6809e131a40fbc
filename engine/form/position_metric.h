#pragma once
#include "engine/form/metric_field.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Adds the form that a position pass shows on a frame. `positions`: H×W×3 of its size, in one unit
/// of length for all frames, in the world, the camera or the object; what is not finite is unknown.
/// `matte`: the visible surface; pixels under 255 are mixed and do not count. `ref_from_cur`: where
/// the frame's pixels lie on the reference frame, to which the metric G is pulled back: M⁻ᵀ G M⁻¹
/// with M = ∂(x + ref_from_cur)/∂x. Steps of the surface come from planes fitted to 5 × 5 px,
/// without pixels across a fold or an edge of depth. Views count by the square of their cosine,
/// times `weight` > 0. Thread-safe.
void add_positions(MetricField& field, ViewF3 positions, ViewU8x1 matte,
                   const LatticeField& ref_from_cur, double weight = 1);

}  // namespace weft
