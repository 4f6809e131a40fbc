#pragma once
#include "engine/core/image.h"

namespace weft {

/// Y / (local mean of Y + 4 levels), the mean a Gaussian of σ 8 px over the pixels with `inside` ≠
/// 0 alone; 0 outside. A smooth change of the light leaves it nearly as it is.
[[nodiscard]] ImageF1 divided_by_local_mean(ViewF1 luma, ViewU8x1 inside);

}  // namespace weft
