#pragma once
// Joint bilateral filtering through a coarse grid over (x, y, guide) (Paris & Durand 2006).

#include "engine/core/image.h"

namespace weft {

struct BilateralScale {
    float space_px = 4;  ///< Standard deviation in pixels.
    float range = 0.1f;  ///< Standard deviation in the guide's unit.
};

/// Mean of `values` (already multiplied by `weight`) over the neighbourhood in space and in
/// `guide`, at every pixel and at its own guide value. All of one size. Where the neighbourhood
/// holds next to nothing the result is the guide itself.
[[nodiscard]] ImageF1 joint_bilateral(const ImageF1& weighted_values, const ImageF1& weight,
                                      const ImageF1& guide, const BilateralScale& scale);

}  // namespace weft
