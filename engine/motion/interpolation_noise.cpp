#include "engine/motion/interpolation_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/motion/cubic_lookup.h"

namespace weft {
namespace {

// Correlations at 0 to 4 pixels.
std::array<float, 5> correlations_at(float neighbours) {
    std::array<float, 5> out{1, neighbours};
    const float squared = neighbours * neighbours;
    // ρ^(d²): from d to d + 1 by ρ^(2d + 1).
    float step = neighbours * squared;
    for (std::size_t d = 2; d < out.size(); ++d, step *= squared)
        out[d] = out[d - 1] * step;
    return out;
}

// The share of the variance that the local mean takes.
float share_of_mean(float neighbours, float local_mean) {
    constexpr float kWhite = 1e-6f, kSmooth = 0.999f;
    const float rho = std::clamp(neighbours, kWhite, kSmooth);
    const float twice = -0.5f / std::log(rho);  // 2 s²
    return 2 * twice / (twice + local_mean) - twice / (twice + 2 * local_mean);
}

}  // namespace

InterpolationNoise::InterpolationNoise(float neighbours, float local_mean)
    : mean_(std::min(share_of_mean(neighbours, local_mean), 0.9f)) {
    const auto correlated = correlations_at(neighbours);
    for (int k = 0; k <= kSteps; ++k) {
        const float t = static_cast<float>(k) / kSteps;
        const F4 w = weights_at(t), s = slopes_at(t);
        At at{0, 0, 0, 0};
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                const float here = correlated[static_cast<std::size_t>(std::abs(i - j))];
                at.variance += w[i] * w[j] * here;
                at.slope += 2 * w[i] * s[j] * here;
                at.roughness += s[i] * s[j] * here;
                at.next += w[i] * w[j] * correlated[static_cast<std::size_t>(std::abs(i - j - 1))];
            }
        }
        steps_[static_cast<std::size_t>(k)] = at;
    }
}

float InterpolationNoise::variance(Vec2 fraction) const {
    return without_mean(at(fraction.x).variance * at(fraction.y).variance);
}

Vec2 InterpolationNoise::slope(Vec2 fraction) const {
    const At &x = at(fraction.x), &y = at(fraction.y);
    return Vec2(x.slope * y.variance, x.variance * y.slope) / (1 - mean_);
}

float InterpolationNoise::roughness(Vec2 fraction) const {
    const At &x = at(fraction.x), &y = at(fraction.y);
    return (x.roughness * y.variance + x.variance * y.roughness) / (1 - mean_);
}

float InterpolationNoise::with_next(Vec2 fraction) const {
    return without_mean(at(fraction.x).next * at(fraction.y).variance);
}

}  // namespace weft
