#pragma once
// Blur that takes nothing from outside of a matte.

#include <vector>

#include "engine/core/image.h"

namespace weft {

/// A Gaussian of deviation `sigma` (above 0) at whole steps, out to three deviations; its sum is 1.
[[nodiscard]] std::vector<float> gaussian_kernel(float sigma);

/// Blurs by a Gaussian of deviation `sigma_px`, from pixels where the matte is above 0 only; the
/// others are left as they are. Less than 0.2 px changes nothing. Normalised convolution
/// (Knutsson & Westin 1993), along rows and then columns; the same for any number of threads.
void blur_inside(ImageView<float, 3> picture, ViewU8x1 matte, float sigma_px);

}  // namespace weft
