#include "engine/composite/blend_mode.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/color/color_space.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

using Rgb = std::array<float, 3>;

float screen(float below, float layer) {
    if (below > 1 && layer > 1) return std::max(below, layer);
    return below + layer - below * layer;
}

float overlay(float below, float layer) {
    return below < 0.5f ? 2 * below * layer : 1 - 2 * (1 - below) * (1 - layer);
}

float soft_light(float below, float layer) {
    return (1 - 2 * layer) * below * below + 2 * layer * below;
}

// Under the sRGB curve; above 1 these modes have no meaning, so the layer's own excess is kept.
template <float (*Mode)(float, float)>
float encoded(float below, float layer) {
    if (below > 1 || layer > 1) return layer;
    const float value =
        Mode(linear_to_srgb(std::max(0.0f, below)), linear_to_srgb(std::max(0.0f, layer)));
    return srgb_to_linear(std::max(0.0f, value));
}

Rgb coloured(const float* below, const float* layer) {
    const float own = luma_709(layer);
    const float scale = own > 1e-6f ? std::max(0.0f, luma_709(below)) / own : 0.0f;
    return {scale * layer[0], scale * layer[1], scale * layer[2]};
}

Rgb blended(const float* below, const float* layer, BlendMode mode) {
    const auto each = [&](auto one) {
        return Rgb{one(below[0], layer[0]), one(below[1], layer[1]), one(below[2], layer[2])};
    };
    switch (mode) {
        case BlendMode::kNormal:
            return {layer[0], layer[1], layer[2]};
        case BlendMode::kMultiply:
            return each([](float b, float t) { return b * t; });
        case BlendMode::kScreen:
            return each(screen);
        case BlendMode::kOverlay:
            return each(encoded<overlay>);
        case BlendMode::kSoftLight:
            return each(encoded<soft_light>);
        case BlendMode::kColor:
            return coloured(below, layer);
    }
    return {layer[0], layer[1], layer[2]};
}

}  // namespace

void blend_layer(ImageView<float, 3> layer, ViewF3 below, ViewU8x1 matte, BlendMode mode,
                 float opacity) {
    if (mode == BlendMode::kNormal && opacity >= 1) return;
    parallel_rows(layer.height(), 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < layer.width(); ++x) {
                const float* b = below.pixel(x, y);
                if (matte.row(y)[x] == 0 || !std::isfinite(b[0] + b[1] + b[2])) continue;
                float* t = layer.pixel(x, y);
                const Rgb seen = blended(b, t, mode);
                for (std::size_t c = 0; c < 3; ++c)
                    t[c] = b[c] + opacity * (seen[c] - b[c]);
            }
        }
    });
}

}  // namespace weft
