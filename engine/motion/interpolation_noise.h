#pragma once
// What looking a noisy picture up between its pixels does to the noise.

#include <array>
#include <cstddef>

#include "engine/core/geometry.h"

namespace weft {

/// Between pixels, interpolation takes most of a picture's noise; on them it leaves all. So the
/// squared difference of a picture and another one that is looked up in it is least halfway between
/// pixels, whatever the motion, and registration is drawn there: on faint plaster a step of 0.1 px
/// becomes 0.3. This knows the noise's variance V(x) V(y) at each fraction of a pixel, so that it
/// can be taken off what is minimised, r² − σ² V. Noise whose neighbours correlate by ρ (0 to 1),
/// as a Gaussian leaves it: ρ^(d²) at a distance of d pixels. Immutable.
class InterpolationNoise {
  public:
    /// Noise that is no less between pixels: slope() is 0.
    InterpolationNoise() = default;
    /// `neighbours`: ρ, 0 to 1. `local_mean`: v, px².
    InterpolationNoise(float neighbours, float local_mean);

    /// V at the fractions of a pixel, 0 to 1; 1 on a pixel.
    [[nodiscard]] float variance(Vec2 fraction) const;
    /// Its derivatives by the place, per pixel.
    [[nodiscard]] Vec2 slope(Vec2 fraction) const;
    /// The noise's part in the squared gradient of what is looked up, per px².
    [[nodiscard]] float roughness(Vec2 fraction) const;
    /// The covariance of what is looked up at a fraction and one pixel further along x.
    [[nodiscard]] float with_next(Vec2 fraction) const;
    /// The same on pixels: the correlation of neighbours, without their local mean.
    [[nodiscard]] float of_neighbours() const { return with_next({0, 0}); }

  private:
    static constexpr int kSteps = 64;
    struct At {
        float variance = 1, slope = 0, next = 1, roughness = 0;
    };
    [[nodiscard]] const At& at(float fraction) const {
        const float nearest = fraction * kSteps + 0.5f;
        return steps_[static_cast<std::size_t>(nearest)];
    }
    [[nodiscard]] float without_mean(float covariance) const {
        return (covariance - mean_) / (1 - mean_);
    }
    std::array<At, kSteps + 1> steps_{};
    float mean_ = 0;  // c
};

}  // namespace weft
