#pragma once
#include "engine/core/image.h"

namespace weft {

/// Y / (local mean of Y + 4 levels). The mean is a Gaussian of σ 8 px over the pixels with `inside`
/// ≠ 0; 0 outside. Nearly unchanged by a smooth change of light. H×W, 8-bit units.
[[nodiscard]] ImageF1 divided_by_local_mean(ViewF1 luma, ViewU8x1 inside);

}  // namespace weft
