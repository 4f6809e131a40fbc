#pragma once
// How bright the light on a surface can be.

#include "engine/core/image.h"
#include "engine/lighting/plate_exposure.h"
#include "engine/lighting/shading.h"

namespace weft {

/// The brightest light of the plate as a factor on the light of a surface that takes textures at
/// `exposure` (plate_exposure()): what is brightest in the plate (its 99 % quantile) reflects as
/// much as ExposureGreys::bright. At least 1.5, because the exposure is a guess. `plate`: H×W×3, in
/// linear light or in the space of `greys`; what is not finite does not count. Thread-safe.
[[nodiscard]] float light_ceiling(ViewF3 plate, float exposure, const ExposureGreys& greys = {});

/// Keeps the light's gain S / S₀ below the ceiling, in place, by a shoulder that begins at half of
/// it: a dark surface's sheen is many times as bright as the surface and would be a glow on a
/// bright one. Where light and paint were surely told apart, four times as much is allowed, because
/// the exposure is a guess. `reference` is S₀; the ceiling rises with the mean light of the surface
/// where that is above `reference_mean`, since a flash is light. Light without a map of confidence
/// (a pass, a picture) stays as it is. Thread-safe; parallel over rows.
void limit_light(Shading& shading, float reference, float reference_mean, float ceiling);

/// The mean of S over the pixels where it was estimated; 0 where there are none.
[[nodiscard]] float mean_light(const Shading& shading);

}  // namespace weft
