#pragma once
// The boundary inside a narrow band, as an exact binary minimum cut.

#include "engine/core/image.h"

namespace weft {

/// `log_odds` (H×W): evidence for inside (positive) or outside at each pixel, natural logarithm;
/// `prior_phi`: signed distance of the expected boundary, pixels; only `undecided` pixels
/// (non-zero) are decided, the others keep its sign. The boundary costs least along edges of
/// `frame` (contrast- sensitive 8-neighbour terms, Boykov & Jolly 2001; weight `smoothness` in
/// log-odds per pixel of length). Returns 1 inside, 0 outside. Deterministic.
[[nodiscard]] Image<std::uint8_t, 1> cut_band(ViewU8x3 frame, ViewF1 log_odds, ViewF1 prior_phi,
                                              ViewU8x1 undecided, float smoothness);

/// Flips disconnected parts of `labels` that are smaller than `max_area_px`: inside parts that do
/// not touch the sure inside (`prior_phi` ≥ `core_px`), and outside parts that do not touch the
/// sure outside.
void remove_islands(Image<std::uint8_t, 1>& labels, ViewF1 prior_phi, float core_px,
                    int max_area_px);

}  // namespace weft
