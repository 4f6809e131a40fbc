#include "engine/lighting/light_ceiling.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/lighting/masked_filters.h"

namespace weft {
namespace {

constexpr float kBrightShare = 0.99f;
constexpr int kEvery = 2;  // pixels of the plate, in both directions
constexpr float kLeastCeiling = 1.5f;
constexpr float kKnee = 0.5f;    // of the ceiling
constexpr float kSureTimes = 4;  // light that is sure may be so much above it

// 1 for 1, its slope 1 up to the knee, below `ceiling` everywhere.
float soft_limit(float gain, float ceiling) {
    const float knee = std::max(1.0f, kKnee * ceiling);
    if (gain <= knee) return gain;
    const float room = ceiling - knee;
    return knee + room * std::tanh((gain - knee) / room);
}

}  // namespace

float light_ceiling(ViewF3 plate, float exposure, const ExposureGreys& greys) {
    std::vector<float> lumas;
    for (int y = 0; y < plate.height(); y += kEvery) {
        for (int x = 0; x < plate.width(); x += kEvery) {
            const float luma = luma_709(plate.pixel(x, y));
            if (std::isfinite(luma)) lumas.push_back(luma);
        }
    }
    if (lumas.empty() || !(exposure > 0)) return kLeastCeiling;
    const auto at = lumas.begin() + static_cast<std::ptrdiff_t>(
                                        kBrightShare * static_cast<float>(lumas.size() - 1));
    std::nth_element(lumas.begin(), at, lumas.end());
    return std::max(kLeastCeiling, *at / (greys.bright * exposure));
}

float mean_light(const Shading& shading) {
    double sum = 0, n = 0;
    for (int y = 0; y < shading.inside.height(); ++y) {
        for (int x = 0; x < shading.inside.width(); ++x) {
            if (shading.inside.row(y)[x] == 0) continue;
            sum += static_cast<double>(shading.value.row(y)[x]);
            n += 1;
        }
    }
    return n > 0 ? static_cast<float>(sum / n) : 0.0f;
}

void limit_light(Shading& shading, float reference, float reference_mean, float ceiling) {
    if (shading.sure.empty() || !(reference > 0) || !(reference_mean > 0)) return;
    const float most = ceiling * std::max(1.0f, mean_light(shading) / reference_mean);
    std::atomic<bool> changed = false;
    parallel_rows(shading.value.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            float* s = shading.value.row(y);
            const std::uint8_t* sure = shading.sure.row(y);
            for (int x = 0; x < shading.value.width(); ++x) {
                if (sure[x] == 0) continue;
                const float confidence = static_cast<float>(sure[x]) / 255.0f;
                const float here = most * (1 + (kSureTimes - 1) * confidence);
                const float limited = reference * soft_limit(s[x] / reference, here);
                if (limited == s[x]) continue;
                s[x] = limited;
                changed = true;
            }
        }
    });
    // Beyond the matte it goes on from what is there now.
    if (changed && !shading.inside.empty()) fill_unknown(shading.value, shading.inside);
}

}  // namespace weft
