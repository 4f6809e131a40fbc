#pragma once
// How placements may lie along one axis of the first sweep.

#include <vector>

namespace weft {

/// A block starts `overlap` before the first unfilled pixel and the sample's window may lie on it
/// at t ∈ [lo, hi], so that it reaches back over what is there by min_overlap … overlap and fills
/// all but `hi` px of the rest.
struct SweepAxis {
    int overlap = 0, min_overlap = 0;
    int block = 0;
    int window = 0;  ///< Of a larger sample only a window takes part in one search.
    int lo = 0, hi = 0;
    int advance = 0;  ///< At least so many pixels are filled from the first unfilled one on.
};

/// Where the windows of one axis start, so that they cover the sample and overlap by half.
[[nodiscard]] std::vector<int> window_starts(int sample_px, int window_px);

/// `plane_px` bounds the block on a torus, which must not meet itself. `overlap_px` is clamped to
/// half the sample. With a period the overlap may grow so far that there is always an aligned
/// translation, up to 0.6 of the sample.
[[nodiscard]] SweepAxis make_sweep_axis(int sample_px, int plane_px, bool torus, int overlap_px,
                                        int period_px = 0);

}  // namespace weft
