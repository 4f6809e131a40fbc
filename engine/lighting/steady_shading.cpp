#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/core/median.h"
#include "engine/core/parallel.h"
#include "engine/lighting/fast_math.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/shading.h"

namespace weft {
namespace {

constexpr float kShare = 0.75f;      // of the previous frame where both agree
constexpr float kAgreement = 2.0f;   // deviations of noise
constexpr float kMinNoise = 0.004f;  // ln units: half a level of 8 bits at mid grey
constexpr float kMaxNoise = 0.05f;   // more than that is a change, not noise
constexpr int kChangeWindow_px =
    96;  // to each side, plate pixels: a wider change is a change of light

struct Difference {
    ImageF1 value;  // ln(current / previous moved here)
    ImageF1 known;  // 1 or 0
};

bool inside(const Shading& s, int x, int y) {
    return s.inside.empty() || s.inside.row(y)[x] != 0;
}

// Looks up ln of the previous shading between pixels. False where it was not estimated.
bool sample(const Shading& s, float x, float y, float& value) {
    if (!(x >= 0 && y >= 0 && x <= static_cast<float>(s.value.width() - 1) &&
          y <= static_cast<float>(s.value.height() - 1)))
        return false;
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, s.value.width() - 1),
              y1 = std::min(y0 + 1, s.value.height() - 1);
    if (!inside(s, x0, y0) || !inside(s, x1, y0) || !inside(s, x0, y1) || !inside(s, x1, y1))
        return false;
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const float top = s.value.row(y0)[x0] + fx * (s.value.row(y0)[x1] - s.value.row(y0)[x0]);
    const float low = s.value.row(y1)[x0] + fx * (s.value.row(y1)[x1] - s.value.row(y1)[x0]);
    value = fast_log(std::max(1e-20f, top + fy * (low - top)));
    return true;
}

Difference difference_along_motion(const Shading& current, const Shading& previous, ViewF2 motion) {
    Difference d{ImageF1(current.value.size()), ImageF1(current.value.size())};
    const float scale = 1.0f / static_cast<float>(current.downscale);
    parallel_rows(current.value.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < current.value.width(); ++x) {
                if (!inside(current, x, y)) continue;
                const int half = current.downscale / 2;
                const float* w =
                    motion.pixel(std::min(x * current.downscale + half, motion.width() - 1),
                                 std::min(y * current.downscale + half, motion.height() - 1));
                float before = 0;
                if (!sample(previous, static_cast<float>(x) + w[0] * scale,
                            static_cast<float>(y) + w[1] * scale, before))
                    continue;
                d.value.row(y)[x] = fast_log(current.value.row(y)[x]) - before;
                d.known.row(y)[x] = 1;
            }
        }
    });
    return d;
}

struct Noise {
    float centre = 0;
    float deviation = 0;
};

// Median and median absolute deviation, because a moving shadow changes few pixels.
Noise noise_of(const Difference& d) {
    std::vector<float> values;
    for (std::size_t i = 0; i < d.value.size_bytes() / sizeof(float); ++i) {
        if (d.known.data()[i] != 0) values.push_back(d.value.data()[i]);
    }
    Noise n;
    n.centre = median_of(values, 0.0f);
    for (float& v : values)
        v = std::abs(v - n.centre);
    n.deviation = std::clamp(kDeviationOfMedian * median_of(values, 0.0f), kMinNoise, kMaxNoise);
    return n;
}

// 1 where `x` is well below `limit`, falling to 0 beyond it.
float agreement_within(float x, float limit) {
    const float r = x / limit;
    const float k = std::max(0.0f, 1.0f - r * r / 4.0f);
    return k * k;
}

// The wide part of the difference: a change of the light itself.
ImageF1 wide_change(const Difference& d, const Noise& noise, int window) {
    ImageF1 weight(d.value.size()), sum(d.value.size());
    for (std::size_t i = 0; i < weight.size_bytes() / sizeof(float); ++i) {
        const float away = d.value.data()[i] - noise.centre;
        weight.data()[i] =
            d.known.data()[i] * agreement_within(away, 2.0f * kAgreement * noise.deviation);
        sum.data()[i] = weight.data()[i] * away;
    }
    box_blur(weight, window);
    box_blur(sum, window);
    for (std::size_t i = 0; i < weight.size_bytes() / sizeof(float); ++i)
        sum.data()[i] =
            noise.centre + (weight.data()[i] > 1e-3f ? sum.data()[i] / weight.data()[i] : 0.0f);
    return sum;
}

}  // namespace

Shading steady_shading(const Shading& current, const Shading& previous, ViewF2 prev_from_cur) {
    if (current.value.empty() || previous.value.size() != current.value.size() ||
        previous.downscale != current.downscale || prev_from_cur.empty())
        return current;
    const Difference d = difference_along_motion(current, previous, prev_from_cur);
    const Noise noise = noise_of(d);
    const ImageF1 change = wide_change(d, noise, std::max(2, kChangeWindow_px / current.downscale));
    Shading steady = current;
    parallel_rows(current.value.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < current.value.width(); ++x) {
                if (d.known.row(y)[x] == 0) continue;
                const float flicker = d.value.row(y)[x] - change.row(y)[x];
                const float share =
                    kShare * agreement_within(flicker, kAgreement * noise.deviation);
                if (share > 0) steady.value.row(y)[x] *= fast_exp(-share * flicker);
            }
        }
    });
    return steady;
}

}  // namespace weft
