#pragma once
// How bright a texture of known reflectance is in a shot.

#include "engine/lighting/shading.h"

namespace weft {

/// What greys of the reflectances that plate_exposure() believes in are in the space of its plate.
struct ExposureGreys {
    static constexpr float kOldSurface = 0.25f, kBright = 0.6f, kWhite = 0.9f,
                           kWhitest = 0.95f;  ///< The reflectances.
    float old_surface = kOldSurface, bright = kBright, white = kWhite, whitest = kWhitest;
    /// The plate's codes end at 1, and whoever exposed it kept white below.
    bool ends_at_one = true;
};

/// What white is on one region of a shot, in the plate's values.
struct PlateExposure {
    float white = 1;    ///< In the reference light S₀: the factor for a texture of reflectances.
    float fullest = 1;  ///< In the fullest light on it, the 99 % quantile.
};

/// The most probable exposure of a region, `white` within 1/16 to 4. Three beliefs count alike (in
/// logarithms, with equal spreads): that the old surface reflects 25 % of its light in the median,
/// that what is brightest in the plate (its 95 % quantile) reflects 60 %, and that white is at 0.9
/// in the fullest light on the surface (the 95 % quantile of its shading). Two limits hold besides:
/// white in that light is at most 0.95 if the plate ends at 1, unless the old surface would have to
/// reflect more than 95 % to be as bright as it is (its 95 % quantile, in its own light).
///
/// `plate`: H×W×3, in linear light or in the space of `greys`; `visible`: H×W, pixels under 128 do
/// not count; neither does what is not finite. `shading`: the surface's light on that plate, and
/// `reference` its S₀; null: taken for even. 1 where the region shows nothing. Thread-safe.
[[nodiscard]] PlateExposure plate_exposure(ViewF3 plate, ViewU8x1 visible, const Shading* shading,
                                           float reference, const ExposureGreys& greys = {});

}  // namespace weft
