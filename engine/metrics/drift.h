#pragma once
// Drift (method.md, 7): how far a texture has slid on its surface.

#include <cstdint>

#include "engine/core/image.h"

namespace weft {

/// The remaining motion between two pictures that should show the same texture at the same place.
struct ResidualMotion {
    double mean_px = 0;        ///< Mean length over the patches that were matched.
    double mean_x_px = 0;      ///< Mean of the components: nonzero for a common slide,
    double mean_y_px = 0;      ///< zero for a swim.
    std::int64_t patches = 0;  ///< Patches matched; with 0 the other numbers are undefined.
    /// Patches with texture that were not matched (correlation below 0.5).
    std::int64_t lost = 0;
};

/// Pyramidal Lucas–Kanade (Lucas & Kanade 1981; Bouguet 2001) on patches every `step_px`, each a
/// Gaussian window (σ 6 px, 31 × 31) over pixels inside `region` (255) of the local-mean-normalised
/// luma, so that changes of light do not count as motion. Skips patches without texture in two
/// directions or with less than half of their window inside. Finds slides of up to about 10 px.
/// Independent of the estimators that render. All H×W. Deterministic.
[[nodiscard]] ResidualMotion residual_motion(ViewF1 expected_luma, ViewF1 seen_luma,
                                             ViewU8x1 region, int step_px = 8);

}  // namespace weft
