#include "engine/pipeline/frame_layers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace weft {

FrameLayers::FrameLayers(Size size, bool with_form)
    : patch(size),
      alpha(size),
      edge(size),
      texture(size),
      light(size, 1.0f),
      light_confidence(size),
      gloss(size),
      finish(size),
      st(size),
      seam(size),
      id(size) {
    if (with_form) form = {ImageF3(size), ImageF1(size), ImageF1(size)};
}

namespace {

// The nearest half float, ties to even, as OpenEXR rounds; all steps are exact.
float as_half(float value) {
    constexpr float kLargest = 65504;
    if (!std::isfinite(value)) return value;
    constexpr int kMantissa = 11, kSmallest = -13;
    int exponent = 0;
    std::frexp(value, &exponent);
    const int step = std::max(exponent, kSmallest) - kMantissa;
    const float rounded = std::ldexp(std::nearbyint(std::ldexp(value, -step)), step);
    return std::clamp(rounded, -kLargest, kLargest);
}

float confidence_at(const Shading* light, int x, int y) {
    if (!light || light->sure.empty()) return 1;
    const int u = std::min(x / light->downscale, light->sure.width() - 1);
    const int v = std::min(y / light->downscale, light->sure.height() - 1);
    return static_cast<float>(light->sure.row(v)[u]) / 255.0f;
}

}  // namespace

void add_share(FrameLayers& layers, const LayerShare& share) {
    constexpr float kDark = 1e-6f;
    for (int y = 0; y < share.box.height(); ++y) {
        for (int x = 0; x < share.box.width(); ++x) {
            if (share.matte.row(y)[x] == 0) continue;
            const int px = share.box.x0 + x, py = share.box.y0 + y;
            for (int c = 0; c < 3; ++c) {
                const float gloss = share.gloss.empty() ? 0.0f : share.gloss.pixel(x, y)[c];
                const float before = share.unlit.pixel(x, y)[c];
                const float after = share.lit.pixel(x, y)[c] - gloss;
                layers.texture.at(px, py, c) = before;
                layers.gloss.at(px, py, c) = gloss;
                layers.light.at(px, py, c) = before > kDark ? after / before : 1.0f;
            }
            layers.light_confidence.at(px, py) = confidence_at(share.light, px, py);
            layers.id.at(px, py) = share.id;
            layers.seam.at(px, py) = 0;
            if (!share.coords || share.plane.empty()) continue;
            const float* uv = share.coords->uv.pixel(x, y);
            const float s = uv[0] / static_cast<float>(share.plane.width);
            const float t = 1.0f - uv[1] / static_cast<float>(share.plane.height);
            const bool repeats = share.wrap == WrapMode::kRepeat;
            layers.st.at(px, py, 0) = repeats ? s - std::floor(s) : s;
            layers.st.at(px, py, 1) = repeats ? t - std::floor(t) : t;
            if (share.plane_seams.empty()) continue;
            const int i =
                wrapped_index(static_cast<int>(std::floor(uv[0])), share.plane.width, share.wrap);
            const int j =
                wrapped_index(static_cast<int>(std::floor(uv[1])), share.plane.height, share.wrap);
            layers.seam.at(px, py) = share.plane_seams.row(j)[i] ? 1.0f : 0.0f;
        }
    }
}

void add_patch(FrameLayers& layers, const Recti& box, ViewU8x1 matte, ViewF3 texture) {
    for (int y = 0; y < box.height(); ++y) {
        for (int x = 0; x < box.width(); ++x) {
            const float share = static_cast<float>(matte.row(y)[x]) / 255.0f;
            if (share <= 0) continue;
            float* patch = layers.patch.pixel(box.x0 + x, box.y0 + y);
            float& alpha = layers.alpha.at(box.x0 + x, box.y0 + y);
            for (int c = 0; c < 3; ++c)
                patch[c] = share * texture.pixel(x, y)[c] + (1 - share) * patch[c];
            alpha = share + (1 - share) * alpha;
        }
    }
}

void add_form(FrameLayers& layers, const Recti& box, ViewU8x1 matte, const ShownForm& form) {
    for (int y = 0; y < box.height(); ++y) {
        for (int x = 0; x < box.width(); ++x) {
            if (matte.row(y)[x] == 0) continue;
            const int px = box.x0 + x, py = box.y0 + y;
            std::copy_n(form.normal.pixel(x, y), 3, layers.form.normal.pixel(px, py));
            layers.form.depth.at(px, py) = form.depth.at(x, y);
            layers.form.confidence.at(px, py) = form.confidence.at(x, y);
        }
    }
}

void finish_layers(FrameLayers& layers, ViewF3 plate, ViewF3 composite) {
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            const float alpha = layers.alpha.at(x, y);
            if (alpha <= 0) continue;
            for (int c = 0; c < 3; ++c) {
                const float f = plate.pixel(x, y)[c];
                const float under = std::isfinite(f) ? f * (1 - alpha) : 0.0f;
                layers.edge.at(x, y, c) =
                    composite.pixel(x, y)[c] - (under + layers.patch.at(x, y, c));
            }
        }
    }
}

void note_finish(FrameLayers& layers) {
    const Size size = layers.patch.size();
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float alpha = as_half(layers.alpha.at(x, y));
            if (alpha <= 0) continue;
            for (int c = 0; c < 3; ++c) {
                const float lit =
                    as_half(layers.texture.at(x, y, c)) * as_half(layers.light.at(x, y, c)) +
                    as_half(layers.gloss.at(x, y, c));
                layers.finish.at(x, y, c) = layers.patch.at(x, y, c) / alpha - lit;
            }
        }
    }
}

Matte seam_texels(const TexturePlane& plane) {
    const Size size = plane.source.size();
    Matte out(size);
    const auto differs = [&](int x, int y, int i, int j) {
        const std::int32_t* a = plane.source.pixel(x, y);
        const std::int32_t* b = plane.source.pixel(i, j);
        if (!plane.origin.empty()) {
            const std::uint8_t* from = plane.origin.pixel(x, y);
            const std::uint8_t* to = plane.origin.pixel(i, j);
            if (from[0] != to[0] || from[1] != to[1]) return true;
            // In a rotated sample the neighbour lies in another direction.
            return std::abs(b[0] - a[0]) + std::abs(b[1] - a[1]) != 1;
        }
        return b[0] - a[0] != i - x || b[1] - a[1] != j - y;
    };
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const bool right = x + 1 < size.width && differs(x, y, x + 1, y);
            const bool below = y + 1 < size.height && differs(x, y, x, y + 1);
            out.at(x, y) = right || below ? 255 : 0;
        }
    }
    return out;
}

}  // namespace weft
