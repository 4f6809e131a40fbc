#pragma once
// Drift (method.md, 7): how far a texture has slid on its surface.

#include <cstdint>

#include "engine/core/image.h"

namespace weft {

/// Motion that is left between two pictures that should show the same texture at the same place.
struct ResidualMotion {
    double mean_px = 0;        ///< Mean length over the patches that were found again.
    double mean_x_px = 0;      ///< Mean of the components: a common slide shows here,
    double mean_y_px = 0;      ///< a swim does not.
    std::int64_t patches = 0;  ///< Found again; 0 means that the other numbers say nothing.
    std::int64_t lost = 0;     ///< Had texture but were not found again (correlation below 0.5).
};

/// Pyramidal Lucas–Kanade (Lucas & Kanade 1981; Bouguet 2001) on patches every 8 px, each a
/// Gaussian window (σ 6 px, 31 × 31) over pixels inside `region` (255) of the local-mean-normalised
/// luma, so that a change of the light is no motion. Patches without texture in two directions or
/// with less than half of their window inside are left out. Slides of up to about 10 px are found.
/// Own code, different from the estimators that render. Deterministic.
[[nodiscard]] ResidualMotion residual_motion(ViewF1 expected_luma, ViewF1 seen_luma,
                                             ViewU8x1 region);

}  // namespace weft
