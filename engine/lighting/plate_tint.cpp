#include "engine/lighting/plate_tint.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/quantile.h"

namespace weft {
namespace {

constexpr int kStep = 2;                      // px: every second pixel is enough
constexpr std::size_t kFewestColoured = 256;  // pixels
constexpr float kDarkOfBrightest = 0.02f;     // of the plate's brightest; below this is noise
constexpr float kClipped = 0.97f;             // of white, on a plate without values above it
constexpr float kLeastOf = 0.01f;             // share of the pixels that may have another colour
constexpr float kNoTint = 0.0f, kSureTint = 0.3f;  // ln B/R of the least coloured pixels
constexpr float kOtherShade = 0.1f;                // ln B/R the other way, in the shade
constexpr float kMostTint = 1.0f;                  // ln units
constexpr float kLikelyShare = 0.6f;               // of the shades of grey that is light

struct Pixel {
    float luma = 0;
    float blue_red = 0;  // ln B/R
};

float brightest(ViewF3 plate) {
    float most = 0;
    for (int y = 0; y < plate.height(); y += kStep) {
        for (int i = 0; i < 3 * plate.width(); ++i) {
            if (std::isfinite(plate.row(y)[i])) most = std::max(most, plate.row(y)[i]);
        }
    }
    return most;
}

// The usable pixels of a plate and their shades of grey.
struct Shades {
    std::vector<Pixel> pixels;
    std::array<float, 3> grey{};  // ln R, G and B
};

Shades shades_of(ViewF3 plate) {
    const float peak = brightest(plate);
    const float most = peak <= 1.0f ? kClipped : peak,
                dark = kDarkOfBrightest * std::min(peak, 1.0f);
    std::array<double, 3> grey{};
    Shades out;
    for (int y = 0; y < plate.height(); y += kStep) {
        for (int x = 0; x < plate.width(); x += kStep) {
            const float* p = plate.pixel(x, y);
            if (!std::isfinite(p[0] + p[1] + p[2]) || !(std::min({p[0], p[1], p[2]}) > 0)) continue;
            const float luma = luma_709(p);
            if (luma < dark || std::max({p[0], p[1], p[2]}) > most) continue;
            out.pixels.push_back({luma, std::log(p[2] / p[0])});
            for (std::size_t c = 0; c < 3; ++c)
                grey[c] += std::pow(static_cast<double>(p[c] / most), 6.0);
        }
    }
    if (out.pixels.size() < kFewestColoured) return {};
    for (std::size_t c = 0; c < 3; ++c)
        out.grey[c] = static_cast<float>(std::log(grey[c]) / 6.0);
    return out;
}

float warm_sign(const Shades& shades) {
    return shades.grey[2] < shades.grey[0] ? 1.0f : -1.0f;
}

// ln B/R of what is least like the tint, of `values`; above 0 is the colour opposite to it.
float least_tinted(std::vector<float>& values, float sign) {
    return sign * quantile(values, sign > 0 ? 1.0f - kLeastOf : kLeastOf);
}

// 0 where the picture may show one coloured material, 1 where it shows other colours too.
float other_colours(const Shades& shades) {
    std::vector<float> all;
    for (const Pixel& p : shades.pixels)
        all.push_back(p.blue_red);
    return smooth_step(least_tinted(all, warm_sign(shades)), 0.0f, kOtherShade);
}

// 1 where all that is bright has the tint.
float bright_has_it(const Shades& shades) {
    std::vector<float> values;
    for (const Pixel& p : shades.pixels)
        values.push_back(p.luma);
    const float middle = quantile(values, 0.5f);
    values.clear();
    for (const Pixel& p : shades.pixels)
        if (p.luma >= middle) values.push_back(p.blue_red);
    return smooth_step(-least_tinted(values, warm_sign(shades)), kNoTint, kSureTint);
}

std::array<float, 3> share_of(const std::array<float, 3>& grey, float share) {
    std::array<float, 3> gain, tint;
    for (std::size_t c = 0; c < 3; ++c)
        gain[c] = std::exp(share * (grey[c] - grey[1]));
    const float level = luma_709(gain.data());
    for (std::size_t c = 0; c < 3; ++c)
        tint[c] = std::clamp(std::log(gain[c] / level), -kMostTint, kMostTint);
    return tint;
}

}  // namespace

std::array<float, 3> plate_tint(ViewF3 plate) {
    const Shades shades = shades_of(plate);
    if (shades.pixels.empty()) return {};
    const float share = bright_has_it(shades) * other_colours(shades);
    return share > 0 ? share_of(shades.grey, share) : std::array<float, 3>{};
}

std::array<float, 3> likely_tint(ViewF3 plate) {
    const Shades shades = shades_of(plate);
    if (shades.pixels.empty()) return {};
    return share_of(shades.grey, kLikelyShare * other_colours(shades));
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
