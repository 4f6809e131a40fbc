#pragma once
#include "engine/core/image.h"

namespace weft {

/// Poisson blending (Pérez et al. 2003; OpenCV's seamlessClone, NORMAL_CLONE): the texture's
/// gradients inside the matte (coverage of at least a half), joined to the plate at its border. All
/// H×W, display codes. Returns the plate if the matte is empty. Deterministic.
[[nodiscard]] ImageU8x3 poisson_clone(ViewU8x3 plate, ViewU8x3 texture, ViewU8x1 matte);

}  // namespace weft
