#pragma once
// A plate with an alpha. Surfaces are lit and composited in straight colours, as if the element
// were opaque, and associated ones are multiplied by their alpha again at the end; so the same
// element looks the same from an EXR and from a PNG.

#include "engine/core/alpha.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// The plate's frame as light is estimated from it: straight colours in the working space. `plate`
/// is source.plate(frame). Errors: of the source.
[[nodiscard]] Expected<ImageF3> working_plate(const ShotSource& source, const ShotPlan& plan,
                                              int frame, const ImageF3& plate);

/// The plate in another space, its colours as associated as before.
[[nodiscard]] ImageF3 plate_in(const ImageF3& plate, const PlateAlpha& alpha,
                               const ColorTransform& transform);

/// A matte says how much of a pixel a surface covers, the alpha how much of it the element does. At
/// the element's edge both fall, and what the element shows is still all surface: the surface's
/// share of the element is min(1, matte / alpha). Where an associated alpha is 0 there is none;
/// under a straight one the colour may matter later, and the matte stays. Both H×W.
void take_share_of_element(Matte& matte, const PlateAlpha& alpha);

/// The picture's straight colours where `touched` is above 0 become as associated as the plate's.
void put_alpha_back(ImageView<float, 3> picture, ViewU8x1 touched, const PlateAlpha& alpha);

}  // namespace weft
