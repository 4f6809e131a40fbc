#include "engine/lighting/plate_exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/luma.h"
#include "engine/lighting/coverage.h"
#include "engine/lighting/quantile.h"

namespace weft {
namespace {

constexpr float kBrightShare = 0.95f;
constexpr float kLeastLuma = 1e-4f;  // less is black
constexpr float kLeastExposure = 1.0f / 16, kMostExposure = 4.0f;

}  // namespace

float plate_exposure(ViewF3 plate, ViewU8x1 visible, const ExposureGreys& greys) {
    std::vector<float> inside, all;
    all.reserve(static_cast<std::size_t>(plate.width()) * plate.height());
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            const float luma = luma_709(plate.pixel(x, y));
            if (!std::isfinite(luma)) continue;
            all.push_back(std::clamp(luma, kLeastLuma, 1.0f));
            if (visible.row(y)[x] >= kCoveredFrom) inside.push_back(std::max(kLeastLuma, luma));
        }
    }
    if (inside.empty()) return 1;
    const float here = std::log(quantile(inside, 0.5f) / greys.old_surface);
    const float whole = std::log(quantile(all, kBrightShare) / greys.bright);
    // The third belief, in the logarithm of an exposure of 1, adds nothing.
    return std::clamp(std::exp((here + whole) / 3), kLeastExposure, kMostExposure);
}

}  // namespace weft
