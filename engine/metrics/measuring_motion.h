#pragma once
// Motion for measuring when no true motion is given. It must not come from the estimator that
// rendered (DIS), because a result measured with its own motion looks too good.

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

/// The motion later_from_earlier (pixels) of what lies inside `earlier_matte` (coverage above 0),
/// on the earlier frame's pixels. Lumas in 8-bit units; values that are not finite count as 0.
/// Estimated both ways inside the bounding box of both mattes grown by 48 px. Valid inside that box
/// where the way there and back misses by at most 0.5 px + 5 % of its length, inside the earlier
/// matte and up to `beyond_px` (at most 48) around it; nowhere if a matte is empty. Deterministic
/// for any number of threads. All H×W. Thread-safe.
[[nodiscard]] FlowField measuring_motion(
    ViewF1 earlier_luma, ViewF1 later_luma, ViewU8x1 earlier_matte, ViewU8x1 later_matte,
    MeasuringEstimator estimator = MeasuringEstimator::kDeepFlow, int beyond_px = 0);

}  // namespace weft
