#pragma once
// The part of the surface's lightness that its own colour explains.

#include "engine/lighting/daylight.h"
#include "engine/lighting/surface_sample.h"

namespace weft {

/// The window of colour_cues(), times the pattern's size.
constexpr int kChromaWindow = 2;

/// What the colours of a surface say of its lightness; both of the size of the sample's box.
struct ColourCues {
    ImageF1 paint;  ///< The part of luma that follows the surface's chromaticity; its mean is 0.
    ImageF1 light;  ///< The part that is light, by its colour (SkyShade::light()); or empty.
    DaylightEvidence evidence = {};  ///< SkyShade::evidence().
};

/// In a red and black carpet or an orange and white fur, colour separates paint from shade. The
/// relation (a quadratic in log chromaticity, least squares) is fitted to differences within
/// `window_px` of the downscaled picture; differences that look like skylit shade are left out.
/// This is the colour cue of intrinsic images (Funt et al. 1992; Garces et al. 2012) as a
/// regression. `sample.box` must not be empty.
[[nodiscard]] ColourCues colour_cues(const SurfaceSample& sample, int window_px,
                                     const Daylight& daylight);

}  // namespace weft
