#pragma once
// The part of the surface's lightness that its own colour explains.

#include "engine/lighting/surface_sample.h"

namespace weft {

/// The part of `sample.luma` that follows the surface's chromaticity; its mean is 0. In a red and
/// black carpet or an orange and white fur, colour separates paint from shade. The relation (a
/// quadratic in log chromaticity, least squares) is fitted to differences within `window_px` of the
/// downscaled picture; differences that look like skylit shade are left out. This is the colour cue
/// of intrinsic images (Funt et al. 1992; Garces et al. 2012) as a regression. Has the size of
/// `sample.box`, which must not be empty.
[[nodiscard]] ImageF1 chromatic_reflectance(const SurfaceSample& sample, int window_px);

}  // namespace weft
