#include "engine/synthesis/self_correlation.h"

#include <algorithm>

#include "engine/synthesis/autocovariance.h"

namespace weft {

SelfCorrelation correlation_of(const SelfMismatch& self) {
    SelfCorrelation out{Image<double, 1>(self.mismatch.size()), self.reach};
    for (int y = 0; y < out.values.height(); ++y) {
        for (int x = 0; x < out.values.width(); ++x)
            out.values.at(x, y) = 1 - self.mismatch.at(x, y);
    }
    return out;
}

SelfCorrelation correlation_of(ViewU8x3 picture) {
    const Vec2i reach{picture.width() / 2, picture.height() / 2};
    SelfCorrelation out{autocovariance(picture, reach), reach};
    const double variance = std::max(out.at({0, 0}), 1e-3);
    for (int y = 0; y < out.values.height(); ++y) {
        for (int x = 0; x < out.values.width(); ++x)
            out.values.at(x, y) /= variance;
    }
    return out;
}

std::optional<Vec2i> best_near(const SelfCorrelation& c, Vec2i d, int radius) {
    std::optional<Vec2i> best;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            const Vec2i p = d + Vec2i{x, y};
            if (c.covers(p) && (!best || c.at(p) > c.at(*best))) best = p;
        }
    }
    return best;
}

}  // namespace weft
