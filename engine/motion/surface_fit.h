#pragma once
// From raw motion to the motion of one surface: robust, smooth, and defined everywhere.

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

struct SurfaceFitOptions {
    int spacing_px = 8;        ///< Of the lattice that comes out.
    float finest_px = 8;       ///< σ of the finest local fit.
    float correlation_px = 8;  ///< Over how many pixels the errors of the raw motion hang together:
                               ///< the patch size of the estimator, 1 for exact motion.
    float noise_floor_px = 0.04f;
};

/// How far a pixel's motion can be trusted, 0–255: 0 where `visible` is under 128, within
/// `border_px` of such a pixel (there the occluder's motion leaks in) as far as enough of the
/// region remains, and where `flow.valid` is 0; lower where the picture has no structure.
[[nodiscard]] Matte motion_weights(ViewU8x1 luma, ViewU8x1 visible, ViewU8x1 valid, int border_px);

/// The motion of a surface from raw motion and weights (both H×W, weights 0–255).
///
/// A quadratic model is fitted robustly to the whole region; then local affine corrections of finer
/// and finer support are added, each only as far as the surface as a whole shows deviations that
/// stand out of the noise (empirical Bayes). Rigid surfaces so keep the stiff model, even where a
/// moving shadow pretends otherwise, and cloth gets its folds; where nothing is known (behind
/// holdouts, outside the matte) the stiffer model goes on.
/// Deterministic; pure. With no weight at all the result is zero motion.
[[nodiscard]] LatticeField fit_surface_motion(ViewF2 flow, ViewU8x1 weights,
                                              const SurfaceFitOptions& options);

}  // namespace weft
