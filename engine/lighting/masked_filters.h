#pragma once
// Filters for pictures that are only partly known: weighted sums over windows, divided by the sums
// of the weights (normalised convolution, Knutsson & Westin 1993), and a fill for unknown pixels.

#include "engine/core/image.h"

namespace weft {

constexpr float kLeastWeight = 1e-3f;  ///< A sum of weights that is divided by, at least.

/// Mean over (2 radius + 1)² pixels, in place. Pixels beyond the border count as 0.
void box_blur(ImageF1& plane, int radius_px);

/// A Gaussian of `sigma_px` as three boxes, with 0 beyond the border; in place.
void gaussian_blur(ImageF1& plane, float sigma_px);

/// `plane` × `weight`.
[[nodiscard]] ImageF1 weighted(const ImageF1& plane, const ImageF1& weight);

/// Fills the pixels whose `known` is 0 smoothly from the others (push and pull over a pyramid,
/// Gortler et al. 1996). Leaves known pixels as they are; all 0 if nothing is known.
void fill_unknown(ImageF1& plane, const Matte& known);

/// `plane` minus its mean over a window of `radius_px`, from known pixels only. `weight_mean` is
/// the weight after the same box blur. All H×W.
[[nodiscard]] ImageF1 high_pass(const ImageF1& plane, const ImageF1& weight,
                                const ImageF1& weight_mean, int radius_px);

}  // namespace weft
