#pragma once
// A result compared with the same scene rendered with the new material: inside, in the soft edge
// and in cast shadows, up to one overall gain.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// Two passes over the clip: first gather() every frame, then compare() every frame. All pictures
/// display-encoded RGB, white = 1, of one size. Not thread-safe.
class TruthComparison {
  public:
    /// `blur_px`: both are compared after a Gaussian of this deviation, inside the matte only; for
    /// a truth whose texture resembles the new one but lies at another place. 0: none.
    explicit TruthComparison(float blur_px = 0) : blur_px_(blur_px) {}

    void gather(ViewF3 result, ViewF3 truth, ViewU8x1 matte);

    /// Mean |difference| over channels, 8-bit levels. Empty if a frame has no such pixels.
    struct Frame {
        std::optional<double> inside, soft_edge, shadow;
        /// Median luminance inside, relative to the first compared frame: how well the result
        /// follows changes of light.
        double brightness = 1, true_brightness = 1;
    };
    [[nodiscard]] Frame compare(ViewF3 result, ViewF3 truth, ViewU8x1 matte);

  private:
    float blur_px_;
    double gain_[3] = {1, 1, 1};
    double result_sum_[3] = {0, 0, 0}, truth_sum_[3] = {0, 0, 0};
    double first_ = 0, first_true_ = 0;
};

}  // namespace weft
