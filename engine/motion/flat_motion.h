#pragma once
// The motion of a surface that is one plane.

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// The homography that explains most of a surface's raw motion (fit_plane()), as a field. `flow`,
/// px, and `weights`, 0 where nothing is known (motion_weights()): H×W; `spacing_px`: of the
/// lattice. Pure; deterministic.
[[nodiscard]] LatticeField fit_flat_motion(ViewF2 flow, ViewU8x1 weights, int spacing_px);

/// The homography nearest to a field over what is `visible` (H×W, at least a half covered), defined
/// everywhere. Pure; deterministic.
[[nodiscard]] LatticeField flattened(const LatticeField& field, ViewU8x1 visible);

}  // namespace weft
