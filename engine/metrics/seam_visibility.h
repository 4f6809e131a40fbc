#pragma once
// How much of the seams of a texture an eye would see.

#include "engine/core/image.h"

namespace weft {

/// The share, 0–1, of the seams' pixels at which the picture is steeper than nearly everywhere on
/// the texture within 48 px around them, and by more than a just noticeable step, beyond the share
/// of the texture's own pixels that are so. Steps that follow the texture's own edges, or are
/// fainter than these, are masked by them (contrast masking: Legge, Foley, 1980). `pixels`: encoded
/// or linear; `touched`: 255 where the texture covers all; `seam`: above 0.5 on seams. Below 0: too
/// little of either is in view. Thread-safe.
[[nodiscard]] float seam_visibility(const ImageF3& pixels, const Matte& touched,
                                    const ImageF1& seam);

}  // namespace weft
