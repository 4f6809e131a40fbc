#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/color/color_space.h"
#include "engine/core/parallel.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/shading.h"
#include "engine/lighting/shading_lookup.h"

namespace weft {
namespace {

constexpr float kBaseSigma_px = 12.0f;  // of B, the base of the texture's V
constexpr float kMinBase = 0.02f;       // display V
constexpr int kTextureBand = 8;

bool usable(float light) {
    return std::isfinite(light) && light > 0;
}

// g = 1 + λ (S / S₀ − 1), in linear light.
void gain_row(float* rgb, const std::uint8_t* matte, const std::vector<float>& shading,
              float reference, float strength, const LightOptions& limits) {
    const float inverse = 1.0f / reference;
    for (std::size_t x = 0; x < shading.size(); ++x, rgb += 3) {
        if (matte[x] == 0 || !usable(shading[x])) continue;
        const float gain = std::clamp(1.0f + strength * (shading[x] * inverse - 1.0f),
                                      limits.least_gain, limits.most_gain);
        rgb[0] *= gain, rgb[1] *= gain, rgb[2] *= gain;
    }
}

float display_value(const float* rgb) {
    return linear_to_srgb(std::max({rgb[0], rgb[1], rgb[2]}));
}

// Display-encoded RGB times V' / V. Black has no hue to keep and becomes grey.
void set_display_value(float* rgb, float value, float new_value) {
    if (value == new_value) return;
    for (int c = 0; c < 3; ++c) {
        const float encoded =
            value > 1e-4f ? linear_to_srgb(rgb[c]) * (new_value / value) : new_value;
        rgb[c] = srgb_to_linear(encoded);
    }
}

// B: the texture's display V under a Gaussian, from the pixels inside the matte.
ImageF1 texture_base(ViewF3 texture, ViewU8x1 matte) {
    ImageF1 base(texture.size()), weight(texture.size());
    parallel_rows(texture.height(), kTextureBand, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < texture.width(); ++x) {
                const float value = matte.row(y)[x] ? display_value(texture.pixel(x, y)) : 0.0f;
                if (matte.row(y)[x] == 0 || !std::isfinite(value)) continue;
                weight.row(y)[x] = 1;
                base.row(y)[x] = value;
            }
        }
    });
    gaussian_blur(base, kBaseSigma_px);
    gaussian_blur(weight, kBaseSigma_px);
    for (std::size_t i = 0; i < base.size_bytes() / sizeof(float); ++i)
        base.data()[i] = std::max(kMinBase, base.data()[i] / std::max(1e-6f, weight.data()[i]));
    return base;
}

// `base` null: eq. 8 as printed, λ Φ + (1 − λ) V. Otherwise (λ Φ + (1 − λ) B) V / B.
void display_row(float* rgb, const std::uint8_t* matte, const std::vector<float>& shading,
                 const float* base, float strength) {
    for (std::size_t x = 0; x < shading.size(); ++x, rgb += 3) {
        if (matte[x] == 0 || !usable(shading[x])) continue;
        const float value = display_value(rgb);
        if (!std::isfinite(value)) continue;
        const float light = linear_to_srgb(shading[x]);
        const float from = base ? base[x] : value;
        const float mixed = strength * light + (1.0f - strength) * from;
        set_display_value(rgb, value, base ? mixed * (value / base[x]) : mixed);
    }
}

}  // namespace

void shading_row(const Shading& s, int x0, int y, std::vector<float>& blended,
                 std::vector<float>& out) {
    const float scale = 1.0f / static_cast<float>(s.downscale);
    const int last_x = s.value.width() - 1, last_y = s.value.height() - 1;
    const auto place = [scale](int pixel, int last) {
        return std::clamp((static_cast<float>(pixel) + 0.5f) * scale - 0.5f, 0.0f,
                          static_cast<float>(last));
    };
    const float fy = place(y, last_y);
    const int j = static_cast<int>(fy);
    const float* above = s.value.row(j);
    const float* below = s.value.row(std::min(j + 1, last_y));
    const float share = fy - static_cast<float>(j);
    blended.resize(static_cast<std::size_t>(last_x) + 2);
    for (int i = 0; i <= last_x; ++i)
        blended[static_cast<std::size_t>(i)] = above[i] + share * (below[i] - above[i]);
    blended[static_cast<std::size_t>(last_x) + 1] = blended[static_cast<std::size_t>(last_x)];
    for (std::size_t x = 0; x < out.size(); ++x) {
        const float fx = place(x0 + static_cast<int>(x), last_x);
        const auto i = static_cast<std::size_t>(fx);
        out[x] = blended[i] + (fx - static_cast<float>(i)) * (blended[i + 1] - blended[i]);
    }
}

void apply_light(ImageView<float, 3> texture, Vec2i origin, ViewU8x1 matte, const Shading& shading,
                 float reference, const LightOptions& options) {
    const float strength = std::clamp(options.strength, 0.0f, 1.0f);
    if (texture.empty() || shading.value.empty() || !(strength > 0) || is_transfer(options.form))
        return;
    if (options.form == LightForm::kGain && !usable(reference)) return;
    ImageF1 base;
    if (options.form == LightForm::kDetail) base = texture_base(texture, matte);
    parallel_rows(texture.height(), kTextureBand, [&](int y0, int y1) {
        std::vector<float> blended, light(static_cast<std::size_t>(texture.width()));
        for (int y = y0; y < y1; ++y) {
            shading_row(shading, origin.x, origin.y + y, blended, light);
            if (options.form == LightForm::kGain)
                gain_row(texture.row(y), matte.row(y), light, reference, strength, options);
            else
                display_row(texture.row(y), matte.row(y), light,
                            base.empty() ? nullptr : base.row(y), strength);
        }
    });
}

}  // namespace weft
