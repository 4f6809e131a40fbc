#pragma once
// What of the surface's lightness its own colour explains.

#include "engine/lighting/surface_sample.h"

namespace weft {

/// The part of `sample.luma` that follows the surface's chromaticity, of mean 0: in a red and black
/// carpet or an orange and white fur the colour tells paint from shade. The relation (a quadratic
/// in log chromaticity, least squares) is fitted to differences within `window_px` (of the small
/// picture) only, and not to those towards the bluish shade that the sky fills. This is the colour
/// cue of intrinsic images (Funt et al. 1992; Garces et al. 2012) as a regression. Size of
/// `sample.box`; `sample.box` must not be empty.
[[nodiscard]] ImageF1 chromatic_reflectance(const SurfaceSample& sample, int window_px);

}  // namespace weft
