#pragma once
// The soft edge of a boundary whose place is known, estimated from one frame.

#include "engine/core/image.h"

namespace weft {

/// Coverage of a shape with signed distance `phi` (pixels, H×W). Off the edge 0 or 255; within about
/// `width_px` of it the pixel's colour is projected on the line between the colours of the sure
/// inside and the sure outside nearby, and where those are alike, or the pixel fits neither, the
/// shape alone decides (a ramp of `width_px`).
[[nodiscard]] Matte edge_alpha(ViewU8x3 frame, ViewF1 phi, float width_px);

/// How far a pixel of colour `c` has gone from `outside` to `inside`, and how much that can be
/// believed (0–1), the spread of both colours (per-channel variance summed) being known.
struct MixEstimate {
    float coverage = 0;
    float reliability = 0;
};
[[nodiscard]] MixEstimate estimate_mix(Vec3 c, Vec3 inside, float inside_variance, Vec3 outside,
                                       float outside_variance);

}  // namespace weft
