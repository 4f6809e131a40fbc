#pragma once
// The motion of one surface from raw motion: robust, smooth, and defined everywhere.

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

struct SurfaceFitOptions {
    int spacing_px = 8;   ///< Spacing of the resulting lattice.
    float finest_px = 8;  ///< σ of the finest local fit.
    /// Pixels over which errors of the raw motion are correlated: the estimator's patch size, 1 for
    /// exact motion.
    float correlation_px = 8;
    float noise_floor_px = 0.04f;
};

/// Weights of a surface's raw motion, 0–255: 0 where `visible` is under 128, within `border_px` of
/// such a pixel (the occluder's motion leaks in there) as long as enough of the region remains, and
/// where `valid` is 0; lower where the picture has no structure. All H×W.
[[nodiscard]] Matte motion_weights(ViewU8x1 luma, ViewU8x1 visible, ViewU8x1 valid, int border_px);

/// The motion of a surface from raw motion (pixels) and weights (both H×W, weights 0–255).
///
/// A quadratic model is fitted robustly to the whole region. Then local affine corrections of finer
/// and finer support are added, each only as far as the surface as a whole shows deviations above
/// the noise (empirical Bayes). Rigid surfaces thus keep the stiff model, even under a moving
/// shadow, and cloth gets its folds. Where there is no data (behind holdouts, outside the matte)
/// the stiffer model continues. Deterministic; pure. Without any weight the result is zero motion.
[[nodiscard]] LatticeField fit_surface_motion(ViewF2 flow, ViewU8x1 weights,
                                              const SurfaceFitOptions& options);

}  // namespace weft
