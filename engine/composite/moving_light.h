#pragma once
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// Keeps of the difference of two frames along the surface's motion what can be grain, in place.
/// Grain is fine, light that moves or changes is wide: the means of blocks are taken out, and of
/// `known` (H×W, 255: to be judged by) the blocks in which wide differences remain or too little is
/// known. Returns the variance in each block that stays, in the channel that varies most.
/// Thread-safe.
[[nodiscard]] std::vector<float> leave_out_moving_light(ImageF3& difference, Matte& known);

}  // namespace weft
