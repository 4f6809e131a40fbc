#include "engine/lighting/plate_transfer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/color/color_space.h"
#include "engine/core/finite_rgb.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/lighting/coverage.h"
#include "engine/lighting/fast_math.h"
#include "engine/lighting/shading_lookup.h"

namespace weft {
namespace {

constexpr int kLevels = 1024;  // of a histogram over encoded luma from 0 to kBrightestLuma
constexpr float kBrightestLuma = 4.0f;
constexpr float kMaxCast = 1.0f;  // ln units
constexpr float kLeastLight = 1e-4f;

// Encoded luma of the covered, finite pixels.
std::vector<float> lumas(ViewF3 picture, ViewU8x1 matte) {
    std::vector<float> out;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const float* p = picture.pixel(x, y);
            if (matte.row(y)[x] >= kCoveredFrom && finite_rgb(p))
                out.push_back(linear_to_srgb(std::max(0.0f, luma_709(p))));
        }
    }
    return out;
}

// Gives every pixel of the matte the luma `map` makes of its own, hue and saturation kept.
template <class Map>
void change_luma(ImageView<float, 3> texture, ViewU8x1 matte, float strength, const Map& map) {
    parallel_rows(texture.height(), 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < texture.width(); ++x) {
                float* p = texture.pixel(x, y);
                if (matte.row(y)[x] == 0 || !finite_rgb(p)) continue;
                const float was = luma_709(p);
                if (!(was > 1e-6f)) continue;
                const float luma = linear_to_srgb(was);
                const float is =
                    srgb_to_linear(std::max(0.0f, luma + strength * (map(luma) - luma)));
                for (int c = 0; c < 3; ++c)
                    p[c] *= is / was;
            }
        }
    });
}

struct MeanAndDeviation {
    float mean = 0, deviation = 0;
};

MeanAndDeviation moments(const std::vector<float>& values) {
    double sum = 0, squares = 0;
    for (const float v : values)
        sum += v, squares += static_cast<double>(v) * v;
    const double n = static_cast<double>(values.size());
    const double mean = sum / n;
    return {static_cast<float>(mean),
            static_cast<float>(std::sqrt(std::max(0.0, squares / n - mean * mean)))};
}

// Share of values below each level.
std::vector<float> cumulative(const std::vector<float>& values) {
    std::vector<std::int64_t> counts(kLevels, 0);
    for (const float v : values) {
        const float level = v / kBrightestLuma * (kLevels - 1);
        ++counts[static_cast<std::size_t>(
            std::clamp(level, 0.0f, static_cast<float>(kLevels - 1)))];
    }
    std::vector<float> out(kLevels + 1, 0.0f);
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < kLevels; ++k) {
        sum += counts[k];
        out[k + 1] =
            static_cast<float>(static_cast<double>(sum) / static_cast<double>(values.size()));
    }
    return out;
}

}  // namespace

void transfer_statistics(ImageView<float, 3> texture, ViewF3 plate, ViewU8x1 matte,
                         float strength) {
    const std::vector<float> mine = lumas(texture, matte), old = lumas(plate, matte);
    if (mine.empty() || old.empty()) return;
    const MeanAndDeviation from = moments(mine), to = moments(old);
    const float scale = from.deviation > 1e-5f ? to.deviation / from.deviation : 0.0f;
    change_luma(texture, matte, strength,
                [&](float luma) { return to.mean + scale * (luma - from.mean); });
}

void match_histogram(ImageView<float, 3> texture, ViewF3 plate, ViewU8x1 matte, float strength) {
    const std::vector<float> mine = lumas(texture, matte), old = lumas(plate, matte);
    if (mine.empty() || old.empty()) return;
    const std::vector<float> from = cumulative(mine), to = cumulative(old);
    constexpr float kStep = kBrightestLuma / (kLevels - 1);
    std::vector<float> map(kLevels + 1);
    for (std::size_t k = 0; k <= kLevels; ++k) {
        const auto above = std::lower_bound(to.begin(), to.end(), from[k]);
        const auto j = static_cast<std::size_t>(above - to.begin());
        const float low = j > 0 ? to[j - 1] : 0.0f, high = j <= kLevels ? to[j] : 1.0f;
        const float part = high > low ? (from[k] - low) / (high - low) : 0.0f;
        map[k] = (static_cast<float>(j) - 1.0f + part) * kStep;
    }
    change_luma(texture, matte, strength, [&](float luma) {
        const float at = std::clamp(luma / kStep, 0.0f, static_cast<float>(kLevels) - 0.001f);
        const auto k = static_cast<std::size_t>(at);
        return map[k] + (at - static_cast<float>(k)) * (map[k + 1] - map[k]);
    });
}

LightColour daylight_colour(const Daylight& daylight) {
    LightColour out;
    out.known = daylight.confidence > 0;
    // Over G, which apply_cast() levels.
    const float slope = daylight.confidence * daylight.slope;
    out.slope = {slope * kDaylightRed, 0, slope * kDaylightBlue};
    return out;
}

LightColour light_colour(ViewF3 plate, ViewU8x1 matte, const Shading& shading) {
    struct Sums {
        double n = 0, s = 0, ss = 0;
        std::array<double, 3> c{}, cs{};
    } sums;
    std::vector<float> light(static_cast<std::size_t>(plate.width())), scratch;
    for (int y = 0; y < plate.height(); y += 2) {
        shading_row(shading, 0, y, scratch, light);
        for (int x = 0; x < plate.width(); x += 2) {
            const float* p = plate.pixel(x, y);
            if (matte.row(y)[x] < 250 || !finite_rgb(p)) continue;
            const float luma = luma_709(p);
            if (!(luma > kLeastLight) || !(std::min({p[0], p[1], p[2]}) > 0.05f * luma)) continue;
            const double s = fast_log(std::max(kLeastLight, light[static_cast<std::size_t>(x)]));
            sums.n += 1, sums.s += s, sums.ss += s * s;
            for (std::size_t c = 0; c < 3; ++c) {
                const double v = fast_log(p[c] / luma);
                sums.c[c] += v, sums.cs[c] += v * s;
            }
        }
    }
    LightColour out;
    if (sums.n < 64) return out;
    out.known = true;
    const double mean = sums.s / sums.n, variance = sums.ss / sums.n - mean * mean;
    for (std::size_t c = 0; c < 3; ++c) {
        const double m = sums.c[c] / sums.n;
        // The ridge: almost constant light does not determine its colour's slope.
        out.slope[c] = static_cast<float>((sums.cs[c] / sums.n - m * mean) / (variance + 0.01));
        out.mean[c] = static_cast<float>(m - static_cast<double>(out.slope[c]) * mean);
    }
    return out;
}

void apply_cast(ImageView<float, 3> texture, Vec2i origin, ViewU8x1 matte, const Shading& shading,
                float reference, const LightColour& colour, const LightColour& reference_colour,
                float strength) {
    if (!colour.known || !reference_colour.known || !(strength > 0) || !(reference > 0)) return;
    const float reference_log = fast_log(reference);
    parallel_rows(texture.height(), 8, [&](int y0, int y1) {
        std::vector<float> scratch, light(static_cast<std::size_t>(texture.width()));
        for (int y = y0; y < y1; ++y) {
            shading_row(shading, origin.x, origin.y + y, scratch, light);
            for (int x = 0; x < texture.width(); ++x) {
                const float s = light[static_cast<std::size_t>(x)];
                if (matte.row(y)[x] == 0 || !(s > 0)) continue;
                const float away = fast_log(s);
                std::array<float, 3> gain;
                for (std::size_t c = 0; c < 3; ++c) {
                    const float here = colour.mean[c] + colour.slope[c] * away;
                    const float there =
                        reference_colour.mean[c] + reference_colour.slope[c] * reference_log;
                    gain[c] = fast_exp(strength * std::clamp(here - there, -kMaxCast, kMaxCast));
                }
                const float grey = luma_709(gain.data());
                float* p = texture.pixel(x, y);
                for (std::size_t c = 0; c < 3; ++c)
                    p[c] *= gain[c] / grey;
            }
        }
    });
}

}  // namespace weft
