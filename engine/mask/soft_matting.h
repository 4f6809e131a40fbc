#pragma once
// Edges that are soft over many pixels: hair, fur, motion blur.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// A shape without its strands and gaps: the signed distance, pixels, of what is mostly inside over
/// some 6 px. `phi`: signed distance of the shape. Clamped to ±`limit_px`. Pure.
[[nodiscard]] ImageF1 shape_without_strands(ViewF1 phi, float limit_px);

/// How wide the soft edge is, all around: at each pixel half its width in pixels near by, from
/// where `matte` is neither whole nor empty, within `limit_px` of the boundary of `shape`
/// (shape_without_strands()). 0 where the edge is hard or antialiased: less than two soft pixels a
/// pixel of boundary. Farther from the boundary what is nearest goes on. Pure.
[[nodiscard]] ImageF1 edge_softness(ViewU8x1 matte, ViewF1 shape, float limit_px);

/// What else is held of a pixel's coverage, and how firmly (0: not at all).
struct CoveragePrior {
    ImageF1 value;   ///< 0–1.
    ImageF1 weight;  ///< 1 counts about as much as a pixel's own neighbourhood.
};

/// Coverage in the band |shape| < half_width (both H×W, pixels), outside of it `crisp`, whole or
/// empty: in every 3×3 neighbourhood coverage is nearly linear in colour, so it follows single
/// hairs (the closed form of Levin, Lischinski & Weiss 2008, eq. 12, solved by conjugate gradients
/// over the band alone, the sure pixels around as they are). The prior may be empty. `frame` is
/// encoded for a display. Pure; deterministic for any number of threads.
[[nodiscard]] Matte soft_alpha(ViewU8x3 frame, ViewU8x1 crisp, ViewF1 shape, ViewF1 half_width,
                               const CoveragePrior& prior);

/// Where the colours near by tell a pixel's coverage: the projection on the line between the mean
/// colours of the sure inside and the sure outside, within a few pixels of the band; for
/// soft_alpha().
[[nodiscard]] CoveragePrior colour_prior(ViewU8x3 frame, ViewF1 shape, ViewF1 half_width);

/// `crisp`, a matte whose edge is about a pixel wide and whose boundary has the signed distance
/// `phi`, with its soft edges where `softness` (as from edge_softness()) is not 0. `expected`: the
/// same coverage as it was in the frame before, moved here, may be empty; `steadiness` (0–1) is how
/// much it counts. All of one size. Pure.
[[nodiscard]] Matte with_soft_edges(ViewU8x3 frame, ViewF1 phi, ViewF1 softness, Matte crisp,
                                    ViewU8x1 expected, float steadiness);

}  // namespace weft
