// The smooth correction of register_lattice(): photometric Gauss–Newton on a coarse lattice.

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/motion/bending_system.h"
#include "engine/motion/photometric_register.h"
#include "engine/motion/photometric_samples.h"

namespace weft {
namespace {

// Adds the residuals to the system of a lattice, each of which counts `weight` times.
void fill(BendingSystem& system, const std::vector<RegistrationResidual>& residuals, double scale,
          double weight) {
    NoiseInResiduals noise;
    for (const RegistrationResidual& t : residuals)
        noise.add(t, cauchy(t.r / scale));
    const double half = 0.5 * noise.variance();
    for (const RegistrationResidual& t : residuals) {
        const double w = weight * cauchy(t.r / scale) / (scale * scale);
        const double x = t.gradient.x, y = t.gradient.y;
        system.measure(t.p, {w * x * x, w * x * y, w * y * y},
                       {w * (half * t.noise.x - t.r * x), w * (half * t.noise.y - t.r * y)});
    }
}

}  // namespace

LatticeField register_lattice(const RegistrationPicture& anchor, const RegistrationPicture& cur,
                              const LatticeField& initial, const RegistrationOptions& options) {
    LatticeField field = initial;
    const RegistrationSamples samples = registration_samples(cur, options.samples, options.thinned);
    if (samples.size() < 100) return field;
    // Neighbouring residuals are correlated, two or three at a time.
    constexpr double kIndependent = 0.4;
    const InterpolationNoise noise = noise_between(anchor, cur, initial);
    const double stiffness =
        1.0 / (static_cast<double>(options.stiffness_px) * options.stiffness_px);
    std::vector<glm::dvec2> corrected;
    for (int k = 0; k < options.iterations; ++k) {
        const auto residuals = residuals_at(anchor, samples, places_under(field, samples), noise);
        if (residuals.size() < 100) return initial;
        LatticeField correction(initial.full_size(), options.lattice_px);
        BendingSystem system(correction);
        fill(system, residuals, robust_spread(residuals) / std::sqrt(kIndependent), samples.weight);
        corrected.resize(system.count());
        const auto& x = system.solve(corrected, stiffness, 60);
        float most = 0;
        for (int j = 0; j < correction.nodes().height(); ++j) {
            for (int i = 0; i < correction.nodes().width(); ++i) {
                const std::size_t n = static_cast<std::size_t>(j) *
                                          static_cast<std::size_t>(correction.nodes().width()) +
                                      static_cast<std::size_t>(i);
                const glm::dvec2 d = x[n];
                const Vec2 step(static_cast<float>(std::clamp(d.x, -2.0, 2.0)),
                                static_cast<float>(std::clamp(d.y, -2.0, 2.0)));
                correction.set_node(i, j, step);
                corrected[n] += glm::dvec2(step);
                most = std::max({most, std::abs(step.x), std::abs(step.y)});
            }
        }
        const LatticeField fine = correction.resampled(field.spacing());
        for (int j = 0; j < field.nodes().height(); ++j) {
            for (int i = 0; i < field.nodes().width(); ++i)
                field.set_node(i, j, field.node(i, j) + fine.node(i, j));
        }
        if (most < options.still_px) break;
    }
    return field;
}

}  // namespace weft
