#pragma once
// The geometry of placements along one axis of the first sweep.

#include <optional>
#include <vector>

#include "engine/synthesis/plane_lattice.h"

namespace weft {

/// The least overlap that a plane may ask for, px.
inline constexpr int kLeastOverlap = 12;

/// A block starts `overlap` before the first unfilled pixel. The sample's window lies on it at t ∈
/// [lo, hi], so that it overlaps by min_overlap … overlap and fills all but `hi` px of the rest.
/// All in pixels.
struct SweepAxis {
    int overlap = 0, min_overlap = 0;
    int block = 0;
    int window = 0;  ///< Of a larger sample each search uses only a window.
    int lo = 0, hi = 0;
    int advance = 0;  ///< The least number of pixels that a placement fills.
};

/// The starts of the windows of one axis, which cover the sample and overlap by half.
[[nodiscard]] std::vector<int> window_starts(int sample_px, int window_px);

/// `plane_px` limits the block on a torus, where it must not meet itself. `overlap_px` is clamped
/// to half the sample. With a period the overlap may grow, up to 0.6 of the sample, so that there
/// is always an aligned translation.
[[nodiscard]] SweepAxis make_sweep_axis(int sample_px, int plane_px, bool torus, int overlap_px,
                                        int period_px = 0);
/// With at least `range_px` translations beyond the first, for patches on a lattice; nothing where
/// that would leave a patch less than a third of its size to fill.
[[nodiscard]] std::optional<SweepAxis> make_ranged_axis(int sample_px, int plane_px, bool torus,
                                                        int overlap_px, int range_px);

struct SweepAxes {
    SweepAxis x, y;
};
/// Axes whose translations hold a point of the lattice wherever a block lies, those that leave a
/// patch most to fill; nothing without a lattice, or where it is too wide for the patches.
[[nodiscard]] std::optional<SweepAxes> make_lattice_axes(const PlaneLattice& lattice, Size sample,
                                                         Size plane, bool torus, int overlap_px);

}  // namespace weft
