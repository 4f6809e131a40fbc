#pragma once
// Edges that are soft over many pixels: hair, fur, motion blur.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// A shape without its strands and gaps: the signed distance (pixels) of what is mostly inside over
/// about 6 px. `phi`: signed distance of the shape. Clamped to ±`limit_px`. Pure.
[[nodiscard]] ImageF1 shape_without_strands(ViewF1 phi, float limit_px);

/// Half the width of the soft edge near each pixel, in pixels, measured where `matte` is between 0
/// and 255, within `limit_px` of the boundary of `shape` (shape_without_strands()). 0 where the
/// edge is hard or antialiased: fewer than two soft pixels per pixel of boundary. Farther from the
/// boundary the nearest width continues. Pure.
[[nodiscard]] ImageF1 edge_softness(ViewU8x1 matte, ViewF1 shape, float limit_px);

/// How near to the boundary colours are mixed, px: half of its usual softness, 1.5 to 6. `phi`: its
/// signed distance, of the size of `softness` (edge_softness()). Pure.
[[nodiscard]] float clearance_of(const ImageF1& phi, const ImageF1& softness);

/// A prior for each pixel's coverage.
struct CoveragePrior {
    ImageF1 value;   ///< 0–1.
    ImageF1 weight;  ///< 1 counts about as much as a pixel's own neighbourhood; 0: no prior.
};

/// Coverage in the band |shape| < half_width (both H×W, pixels); outside of it `crisp` holds, 0 or
/// 255. In every 3×3 neighbourhood coverage is nearly linear in colour, so it follows single hairs
/// (the closed form of Levin, Lischinski & Weiss 2008, eq. 12, solved by conjugate gradients over
/// the band, with the sure pixels around it fixed). The prior may be empty. `frame` is
/// display-encoded. Pure; deterministic for any number of threads.
[[nodiscard]] Matte soft_alpha(ViewU8x3 frame, ViewU8x1 crisp, ViewF1 shape, ViewF1 half_width,
                               const CoveragePrior& prior);

/// A prior for soft_alpha() where nearby colours determine coverage: the projection on the line
/// between the mean colours of the sure inside and the sure outside, within a few pixels of the
/// band.
[[nodiscard]] CoveragePrior colour_prior(ViewU8x3 frame, ViewF1 shape, ViewF1 half_width);

/// `crisp`, a matte whose edge is about a pixel wide and whose boundary has the signed distance
/// `phi`, with soft edges where `softness` (from edge_softness()) is not 0. `expected`: the same
/// coverage in the frame before, warped to this one; may be empty. `steadiness` (0–1): its weight.
/// All H×W. Pure.
[[nodiscard]] Matte with_soft_edges(ViewU8x3 frame, ViewF1 phi, ViewF1 softness, Matte crisp,
                                    ViewU8x1 expected, float steadiness);

}  // namespace weft
