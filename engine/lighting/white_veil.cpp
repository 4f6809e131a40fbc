#include "engine/lighting/white_veil.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/luma.h"
#include "engine/lighting/quantile.h"

namespace weft {
namespace {

constexpr float kLow = 0.02f, kHigh = 0.98f;
constexpr int kSampled = 320;                 // columns that are looked at, at most
constexpr float kNone = 0.05f, kFull = 0.1f;  // below, none; above, as much as is found

// How far `low` has risen on its way to white.
float risen(float low, float before) {
    return before < 1 ? (low - before) / (1 - before) : 0;
}

}  // namespace

LightRange light_range(ViewF3 linear, ViewU8x1 visible) {
    std::vector<float> values;
    const int step = std::max(1, linear.width() / kSampled);
    for (int y = step / 2; y < linear.height(); y += step) {
        for (int x = step / 2; x < linear.width(); x += step) {
            if (!visible.empty() && visible.row(y)[x] < 128) continue;
            const float luma = luma_709(linear.pixel(x, y));
            if (std::isfinite(luma)) values.push_back(std::clamp(luma, 0.0f, 1.0f));
        }
    }
    if (values.empty()) return {};
    return {quantile(values, kLow), quantile(values, 0.5f), quantile(values, kHigh)};
}

float white_share(const SurfaceLightRange& without, const SurfaceLightRange& frame) {
    const float contrast = without.picture.high - without.picture.low;
    if (!(contrast > 0)) return 0;
    const float lost = 1 - (frame.picture.high - frame.picture.low) / contrast;
    const float share = std::min({lost, risen(frame.picture.low, without.picture.low),
                                  risen(frame.surface.low, without.surface.low)});
    if (!(share > kNone)) return 0;
    return std::min(1.0f, share * std::min(1.0f, (share - kNone) / (kFull - kNone)));
}

}  // namespace weft
