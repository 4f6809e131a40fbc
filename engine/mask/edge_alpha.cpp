#include "engine/mask/edge_alpha.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"

namespace weft {
namespace {}  // namespace

MixEstimate estimate_mix(Vec3 c, Vec3 inside, float inside_variance, Vec3 outside,
                         float outside_variance) {
    constexpr float kNoise = 30;  // levels², three channels: grain and compression
    const Vec3 axis = inside - outside;
    const float length2 = glm::dot(axis, axis);
    MixEstimate mix;
    if (length2 < 1) return mix;
    const float t = glm::dot(c - outside, axis) / length2;
    mix.coverage = std::clamp(t, 0.0f, 1.0f);
    const Vec3 off = c - (outside + axis * mix.coverage);
    const float spread = inside_variance + outside_variance + kNoise;
    // Reliable if the colours are far apart compared with their spread and the pixel is near their
    // line.
    const float apart = length2 / (length2 + 4 * spread);
    const float fits = spread / (spread + glm::dot(off, off));
    mix.reliability = std::clamp(2 * apart - 1, 0.0f, 1.0f) * std::min(1.0f, 2 * fits);
    return mix;
}

Matte edge_alpha(ViewU8x3 frame, ViewF1 phi, float width_px) {
    const int w = frame.width(), h = frame.height();
    const float reach = 0.5f + width_px;  // beyond it a pixel is sure
    Matte alpha(frame.size());
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x) {
                const float d = phi.row(y)[x];
                if (std::abs(d) >= reach) {
                    alpha.row(y)[x] = d > 0 ? 255 : 0;
                    continue;
                }
                ColorSum in, out;
                for (int v = std::max(0, y - kSureColorReachPx);
                     v <= std::min(h - 1, y + kSureColorReachPx); ++v) {
                    for (int u = std::max(0, x - kSureColorReachPx);
                         u <= std::min(w - 1, x + kSureColorReachPx); ++u) {
                        const float e = phi.row(v)[u];
                        if (std::abs(e) < 1.5f) continue;
                        const auto r2 = static_cast<float>((u - x) * (u - x) + (v - y) * (v - y));
                        (e > 0 ? in : out).add(frame.pixel(u, v), 1 / (1 + r2));
                    }
                }
                float value = std::clamp(0.5f + d / width_px, 0.0f, 1.0f);
                if (in.n > 0 && out.n > 0) {
                    const std::uint8_t* p = frame.pixel(x, y);
                    const MixEstimate mix = estimate_mix(Vec3(p[0], p[1], p[2]), in.mean(),
                                                         in.variance(), out.mean(), out.variance());
                    // The colour may move the edge by at most a pixel, because the cut has placed
                    // it.
                    const float low = std::clamp(0.5f + (d - 1) / width_px, 0.0f, 1.0f);
                    const float high = std::clamp(0.5f + (d + 1) / width_px, 0.0f, 1.0f);
                    value += mix.reliability * (std::clamp(mix.coverage, low, high) - value);
                }
                alpha.row(y)[x] = static_cast<std::uint8_t>(value * 255 + 0.5f);
            }
        }
    });
    return alpha;
}

}  // namespace weft
