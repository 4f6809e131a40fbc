#pragma once
// Whether a variation has the statistics of folds.

#include "engine/core/image.h"

namespace weft {

/// 0 to 1: how far `plane` (ln luma of one cause, H×W) varies as folds do and paint does not: in
/// lengths of folds, a share of `window_px`; all over the surface, where paints meet at edges;
/// without two values; and in one direction at each place, over several widths, where soft paints,
/// clouds and stains have none. `smooth_px`: the blur before directions are measured, since noise
/// has none. `weight`: 0 to 1; the rim does not count. Thread-safe.
[[nodiscard]] float fold_share(const ImageF1& plane, const ImageF1& weight, int window_px,
                               float smooth_px);

}  // namespace weft
