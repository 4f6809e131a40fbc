#pragma once
#include "engine/core/image.h"

namespace weft {

/// The longest period of a pattern along the picture's axes, in pixels: the first clear peak of its
/// autocorrelation along x or y, whichever is longer, up to `longest`. 0 if the pattern does not
/// repeat. Pixels of weight 0 are ignored.
[[nodiscard]] int pattern_period_px(const ImageF1& pattern, const ImageF1& weight, int longest);

}  // namespace weft
