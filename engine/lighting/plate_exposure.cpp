#include "engine/lighting/plate_exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/luma.h"
#include "engine/lighting/coverage.h"
#include "engine/lighting/quantile.h"
#include "engine/lighting/shading_lookup.h"

namespace weft {
namespace {

constexpr float kBrightShare = 0.95f;
constexpr float kFullestShare = 0.99f;
constexpr float kLeastLuma = 1e-4f;  // less is black
constexpr float kLeastGain = 0.02f;  // what has less light does not show its paint
constexpr float kLeastExposure = 1.0f / 16, kMostExposure = 4.0f;

struct Lumas {
    std::vector<float> all;      // of the plate, none above 1
    std::vector<float> surface;  // of the region
    std::vector<float> gain;     // the light there, over the reference light
    std::vector<float> paint;    // its luma over that
};

Lumas lumas_of(ViewF3 plate, ViewU8x1 visible, const Shading* shading, float reference) {
    const bool lit = shading && !shading->value.empty() && reference > 0;
    Lumas out;
    out.all.reserve(static_cast<std::size_t>(plate.width()) * plate.height());
    std::vector<float> scratch, light(static_cast<std::size_t>(plate.width()), reference);
    for (int y = 0; y < plate.height(); ++y) {
        if (lit) shading_row(*shading, 0, y, scratch, light);
        for (int x = 0; x < plate.width(); ++x) {
            const float luma = luma_709(plate.pixel(x, y));
            if (!std::isfinite(luma)) continue;
            out.all.push_back(std::clamp(luma, kLeastLuma, 1.0f));
            if (visible.row(y)[x] < kCoveredFrom) continue;
            const float gain = lit ? light[static_cast<std::size_t>(x)] / reference : 1.0f;
            if (!std::isfinite(gain) || !(gain > 0)) continue;
            out.surface.push_back(std::max(kLeastLuma, luma));
            out.gain.push_back(gain);
            if (gain >= kLeastGain) out.paint.push_back(std::max(kLeastLuma, luma) / gain);
        }
    }
    return out;
}

}  // namespace

PlateExposure plate_exposure(ViewF3 plate, ViewU8x1 visible, const Shading* shading,
                             float reference, const ExposureGreys& greys) {
    Lumas lumas = lumas_of(plate, visible, shading, reference);
    if (lumas.surface.empty()) return {};
    const float full = quantile(lumas.gain, kBrightShare);
    const float here = std::log(quantile(lumas.surface, 0.5f) / greys.old_surface);
    const float whole = std::log(quantile(lumas.all, kBrightShare) / greys.bright);
    const float in_full = std::log(greys.white / full);
    float white = std::exp((here + whole + in_full) / 3);
    if (greys.ends_at_one) white = std::min(white, greys.whitest / full);
    if (!lumas.paint.empty())
        white = std::max(white, quantile(lumas.paint, kBrightShare) / greys.whitest);
    white = std::clamp(white, kLeastExposure, kMostExposure);
    return {white, white * quantile(lumas.gain, kFullestShare)};
}

}  // namespace weft
