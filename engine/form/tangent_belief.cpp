// What motion says of the lens.
#include <cmath>

#include "engine/form/rigid_fit.h"

namespace weft {
namespace {

constexpr double kSays = 0.2;      // of what was believed, that motion has to add to be heard
constexpr double kAlike = 0.04;    // error of a tangent that its covariance does not tell, relative
constexpr double kContradict = 6;  // square of an error, in deviations, by surface

}  // namespace

std::optional<TangentBelief> RigidFit::measured_tangent() const {
    const auto information = [](double deviation) { return 1 / (deviation * deviation); };
    const double before = information(believed.deviation), after = information(tangent_error);
    const double own = after - before;
    if (!(own > kSays * before)) return std::nullopt;
    const double value = (after * surface.tangent - before * believed.value) / own;
    if (!(value > 0)) return std::nullopt;
    return TangentBelief{value, 1 / std::sqrt(own)};
}

std::optional<TangentBelief> shared_tangent(const std::vector<TangentBelief>& measured) {
    if (measured.size() < 2) return std::nullopt;
    // Errors of tracks are alike over a region, which its covariance does not know.
    const auto weight = [](const TangentBelief& m) {
        const double alike = kAlike * m.value;
        return 1 / (m.deviation * m.deviation + alike * alike);
    };
    double sum = 0, all = 0;
    for (const TangentBelief& m : measured)
        sum += weight(m) * m.value, all += weight(m);
    const double mean = sum / all;
    double off = 0;
    for (const TangentBelief& m : measured)
        off += weight(m) * (m.value - mean) * (m.value - mean);
    if (off > kContradict * static_cast<double>(measured.size() - 1)) return std::nullopt;
    // With what is believed of lenses in general.
    const TangentBelief common;
    const double before = 1 / (common.deviation * common.deviation);
    return TangentBelief{(sum + before * common.value) / (all + before),
                         1 / std::sqrt(all + before)};
}

}  // namespace weft
