#include "engine/composite/grain_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace weft {
namespace {

constexpr int kSize = 16;           // frequencies along x and y
constexpr double kMostLost = 0.15;  // of a frequency's power; a larger loss is not restored

using Plane = std::array<std::array<double, kSize>, kSize>;

std::size_t lag(int x, int y) {
    return static_cast<std::size_t>((y + GrainModel::kRadius) * GrainModel::kSide + x +
                                    GrainModel::kRadius);
}

double cosine(int a) {
    // Long double: see docs/decisions/0002-determinism.md.
    return static_cast<double>(std::cos(2 * std::numbers::pi_v<long double> * a / kSize));
}

double& at(Plane& plane, int u, int v) {
    return plane[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)];
}

// Power by frequency. The taper avoids ringing from the cut at the reach.
Plane power_of(const GrainLags& lags, bool tapered) {
    Plane power{};
    const double centre = std::max(lags[lag(0, 0)], 1e-30);
    for (int v = 0; v < kSize; ++v) {
        for (int u = 0; u < kSize; ++u) {
            for (int y = -GrainModel::kRadius; y <= GrainModel::kRadius; ++y) {
                for (int x = -GrainModel::kRadius; x <= GrainModel::kRadius; ++x) {
                    const double r2 =
                        static_cast<double>(x * x + y * y) /
                        (GrainModel::kRadius * GrainModel::kRadius + GrainModel::kRadius);
                    const double taper = tapered ? std::max(0.0, 1 - r2 * r2 * r2 * r2) : 1.0;
                    at(power, u, v) += taper * cosine(u * x + v * y) * lags[lag(x, y)] / centre;
                }
            }
        }
    }
    return power;
}

// Back in space, within the reach.
GrainLags in_space(Plane& plane) {
    GrainLags out{};
    for (int y = -GrainModel::kRadius; y <= GrainModel::kRadius; ++y) {
        for (int x = -GrainModel::kRadius; x <= GrainModel::kRadius; ++x) {
            for (int v = 0; v < kSize; ++v) {
                for (int u = 0; u < kSize; ++u)
                    out[lag(x, y)] += at(plane, u, v) * cosine(u * x + v * y);
            }
        }
    }
    return out;
}

}  // namespace

GrainSpectrum grain_spectrum(const GrainLags& seen, const GrainLags& lookup) {
    Plane power = power_of(seen, true), lost = power_of(lookup, false), root{};
    for (int v = 0; v < kSize; ++v) {
        for (int u = 0; u < kSize; ++u) {
            // Autocorrelations are even, so there are no sines; negative power is chance.
            double& p = at(power, u, v);
            p = std::max(0.0, p) / std::max(kMostLost, at(lost, u, v) / at(lost, 0, 0));
            at(root, u, v) = std::sqrt(p);
        }
    }
    GrainSpectrum out;
    out.correlation = in_space(power);
    const double whole = std::max(out.correlation[lag(0, 0)], 1e-30);
    for (double& c : out.correlation)
        c /= whole;
    const GrainLags kernel = in_space(root);
    double energy = 0;
    for (const double k : kernel)
        energy += k * k;
    for (std::size_t i = 0; i < kernel.size(); ++i)
        out.kernel[i] = static_cast<float>(kernel[i] / std::sqrt(std::max(energy, 1e-30)));
    return out;
}

}  // namespace weft
