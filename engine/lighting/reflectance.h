#pragma once
// What of the surface's lightness its own colour explains.

#include "engine/lighting/surface_sample.h"

namespace weft {

/// Takes the part of `sample.luma` that follows the surface's chromaticity out of it, in place: in
/// a red and black carpet or an orange and white fur the colour tells paint from shade. The
/// relation (a quadratic in log chromaticity, least squares) is fitted to differences within
/// `window_px` (of the small picture) only, so that wide shadows, bluish as they may be, do not
/// enter it. The mean stays. This is the colour cue of intrinsic images (Funt et al. 1992; Garces
/// et al. 2012) as a regression.
void remove_chromatic_reflectance(SurfaceSample& sample, int window_px);

}  // namespace weft
