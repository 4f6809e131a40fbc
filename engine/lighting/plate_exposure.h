#pragma once
// How bright a texture of known reflectance is in a shot.

#include "engine/core/image.h"

namespace weft {

/// What greys of the reflectances that plate_exposure() believes in are in the space of its plate.
struct ExposureGreys {
    static constexpr float kOldSurface = 0.25f, kBright = 0.6f;  ///< The reflectances.
    float old_surface = kOldSurface, bright = kBright;
};

/// The factor that brings a texture, whose values are taken for reflectances, to the exposure of
/// the plate on one region: the most probable value of what a white surface has there, within 1/16
/// to 4. Three beliefs count alike (in logarithms, with equal spreads): that the
/// old surface reflects 25 % of its light, that what is brightest in the plate (its 95 % quantile)
/// reflects 60 %, and that the shot was exposed for white at 1. 1 where the region shows nothing.
/// `plate`: H×W×3, in linear light or in the space of `greys`; `visible`: H×W, pixels under 128 do
/// not count; neither does what is not finite. Thread-safe.
[[nodiscard]] float plate_exposure(ViewF3 plate, ViewU8x1 visible, const ExposureGreys& greys = {});

}  // namespace weft
