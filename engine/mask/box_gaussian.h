#pragma once
#include "engine/core/image.h"

namespace weft {

/// Blurs by a Gaussian of deviation `sigma_px`, as three box filters with soft ends (Gwosdek et al.
/// 2011) along rows and columns: the time does not depend on sigma. The border repeats. Below
/// 0.05 px nothing changes. Thread-safe; the same for any number of threads.
[[nodiscard]] ImageF1 box_gaussian(ImageF1 image, float sigma_px);
/// Beyond how many pixels it reaches nothing.
[[nodiscard]] int box_gaussian_reach(float sigma_px);

}  // namespace weft
