#include "engine/lighting/plate_tint.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"

namespace weft {
namespace {

constexpr int kStep = 2;              // px: every second pixel is enough
constexpr std::size_t kFewest = 256;  // pixels
constexpr float kDark = 0.02f;        // of the plate's brightest; below this is noise
constexpr float kClipped = 0.97f;     // of white, on a plate without values above it
constexpr float kLeastOf = 0.01f;     // share of the pixels that may have another colour
constexpr float kNoTint = 0.0f, kSureTint = 0.3f;  // ln B/R of the least coloured pixels
constexpr float kOtherShade = 0.1f;                // ln B/R the other way, in the shade
constexpr float kMost = 1.0f;                      // ln units

struct Pixel {
    float luma = 0;
    float blue_red = 0;  // ln B/R
};

float quantile(std::vector<float>& values, float share) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<float>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

float brightest(ViewF3 plate) {
    float most = 0;
    for (int y = 0; y < plate.height(); y += kStep) {
        for (int i = 0; i < 3 * plate.width(); ++i) {
            if (std::isfinite(plate.row(y)[i])) most = std::max(most, plate.row(y)[i]);
        }
    }
    return most;
}

}  // namespace

std::array<float, 3> plate_tint(ViewF3 plate) {
    const float peak = brightest(plate);
    const float most = peak <= 1.0f ? kClipped : peak, dark = kDark * std::min(peak, 1.0f);
    std::array<double, 3> grey{};
    std::vector<Pixel> pixels;
    std::vector<float> values;
    for (int y = 0; y < plate.height(); y += kStep) {
        for (int x = 0; x < plate.width(); x += kStep) {
            const float* p = plate.pixel(x, y);
            if (!std::isfinite(p[0] + p[1] + p[2]) || !(std::min({p[0], p[1], p[2]}) > 0)) continue;
            const float luma = luma_709(p);
            if (luma < dark || std::max({p[0], p[1], p[2]}) > most) continue;
            pixels.push_back({luma, std::log(p[2] / p[0])});
            values.push_back(luma);
            for (std::size_t c = 0; c < 3; ++c)
                grey[c] += std::pow(static_cast<double>(p[c] / most), 6.0);
        }
    }
    if (pixels.size() < kFewest) return {};
    std::array<float, 3> tint;
    for (std::size_t c = 0; c < 3; ++c)
        tint[c] = static_cast<float>(std::log(grey[c]) / 6.0);
    const float middle = quantile(values, 0.5f);
    std::vector<float> all;
    values.clear();
    for (const Pixel& p : pixels) {
        all.push_back(p.blue_red);
        if (p.luma >= middle) values.push_back(p.blue_red);
    }
    const bool warm = tint[2] < tint[0];
    const float least = warm ? 1.0f - kLeastOf : kLeastOf, sign = warm ? 1.0f : -1.0f;
    const float share = smooth_step(-sign * quantile(values, least), kNoTint, kSureTint) *
                        smooth_step(sign * quantile(all, least), 0.0f, kOtherShade);
    if (!(share > 0)) return {};
    std::array<float, 3> gain;
    for (std::size_t c = 0; c < 3; ++c)
        gain[c] = std::exp(share * (tint[c] - tint[1]));
    const float level = luma_709(gain.data());
    for (std::size_t c = 0; c < 3; ++c)
        tint[c] = std::clamp(std::log(gain[c] / level), -kMost, kMost);
    return tint;
}

void apply_tint(ImageView<float, 3> texture, ViewU8x1 matte, const std::array<float, 3>& tint,
                float strength) {
    if (!(strength > 0) || tint == std::array<float, 3>{}) return;
    std::array<float, 3> gain;
    for (std::size_t c = 0; c < 3; ++c)
        gain[c] = std::exp(strength * tint[c]);
    const float level = luma_709(gain.data());
    parallel_rows(texture.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < texture.width(); ++x) {
                if (matte.row(y)[x] == 0) continue;
                for (std::size_t c = 0; c < 3; ++c)
                    texture.pixel(x, y)[c] *= gain[c] / level;
            }
        }
    });
}

}  // namespace weft
