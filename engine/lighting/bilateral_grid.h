#pragma once
// Joint bilateral filtering through a coarse grid over (x, y, guide) (Paris & Durand 2006); up to
// one pixel and a half, by sums.

#include "engine/core/image.h"

namespace weft {

struct BilateralScale {
    float space_px = 4;  ///< Standard deviation in pixels; less than 0.7 is taken as 0.7.
    float range = 0.1f;  ///< Standard deviation in the guide's unit.
};

/// Weighted mean of the values over each pixel's neighbourhood in space and in `guide`, taken at
/// the pixel's own guide value. `weighted_values` is values × weight. All H×W. Where the
/// neighbourhood has almost no weight, the result is the guide itself.
[[nodiscard]] ImageF1 joint_bilateral(const ImageF1& weighted_values, const ImageF1& weight,
                                      const ImageF1& guide, const BilateralScale& scale);

}  // namespace weft
