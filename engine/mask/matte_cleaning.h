#pragma once
#include "engine/core/image.h"

namespace weft {

/// Removes islands of `alpha` (0 to 1): connected sets of pixels of at least one half, corners
/// included, of fewer than `min_px` pixels, with the soft pixels that are reached downhill from
/// them and not from another set; and spots that reach one half nowhere and whose coverage sums to
/// less than `min_px`.
void remove_islands(ImageF1& alpha, int min_px);
/// The same of the inverted matte: holes. Corners do not connect them, and one that reaches the
/// border of the image is none.
void fill_holes(ImageF1& alpha, int min_px);

}  // namespace weft
