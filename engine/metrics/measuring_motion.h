#pragma once
// Motion to measure with when no true motion is given. It must not be the estimator that rendered
// (DIS): a result measured with its own motion flatters itself.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

enum class MeasuringEstimator {
    /// Variational coarse-to-fine flow (OpenCV's DeepFlow, after Weinzaepfel et al. 2013 without
    /// the matching term). About 1 s a direction for 854×480 on one core.
    kDeepFlow,
    /// Polynomial expansion (Farnebäck 2003). About 0.1 s a direction for 854×480 on one core; less
    /// exact on planes seen at a low angle.
    kFarneback,
};

/// "deepflow" or "farneback", for reports.
[[nodiscard]] const char* name_of(MeasuringEstimator estimator);

/// The motion later_from_earlier of what lies inside `earlier_matte` (coverage above 0), on the
/// earlier frame's pixels. Lumas in 8-bit units; not finite values count as 0. Estimated both ways
/// inside the bounding box of both mattes grown by 48 px; valid inside that box where going there
/// and back misses by at most 0.5 px + 5 % of the way, inside the earlier matte and up to
/// `beyond_px` (at most 48) around it. Not valid anywhere when a matte is empty.
/// Deterministic, whatever the number of threads. All four of one size. Thread-safe.
[[nodiscard]] FlowField measuring_motion(
    ViewF1 earlier_luma, ViewF1 later_luma, ViewU8x1 earlier_matte, ViewU8x1 later_matte,
    MeasuringEstimator estimator = MeasuringEstimator::kDeepFlow, int beyond_px = 0);

}  // namespace weft
