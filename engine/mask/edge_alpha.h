#pragma once
// The soft edge of a boundary whose position is known, estimated from one frame.

#include <algorithm>
#include <cstdint>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

constexpr int kSureColorReachPx = 4;  ///< How far sure colours are searched.

/// Coverage of a shape with signed distance `phi` (pixels, H×W). Away from the edge it is 0 or 255.
/// Within about `width_px` of the edge the pixel's colour is projected on the line between the sure
/// inside and outside colours nearby. Where those are alike, or the pixel fits neither, the shape
/// alone decides (a ramp of `width_px`).
[[nodiscard]] Matte edge_alpha(ViewU8x3 frame, ViewF1 phi, float width_px);

/// Weighted mean and spread of colours.
struct ColorSum {
    Vec3 sum{0}, squares{0};
    float n = 0;

    void add(const std::uint8_t* rgb, float weight) {
        const Vec3 c(rgb[0], rgb[1], rgb[2]);
        sum += weight * c;
        squares += weight * c * c;
        n += weight;
    }
    [[nodiscard]] Vec3 mean() const { return sum / n; }
    /// Per-channel variances, summed.
    [[nodiscard]] float variance() const {
        const Vec3 v = squares / n - mean() * mean();
        return std::max(0.0f, v.x + v.y + v.z);
    }
};

/// How far a colour has gone from `outside` (0) to `inside` (1), and how reliable that is (0–1),
/// given the spread of both colours (per-channel variances, summed).
struct MixEstimate {
    float coverage = 0;
    float reliability = 0;
};
[[nodiscard]] MixEstimate estimate_mix(Vec3 c, Vec3 inside, float inside_variance, Vec3 outside,
                                       float outside_variance);

}  // namespace weft
