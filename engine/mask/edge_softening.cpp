#include "engine/mask/edge_softening.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/edge_alpha.h"

namespace weft {
namespace {

constexpr float kOutsideClear = 1;  // mixed pixels lie on both sides of a hard edge

// Distance from every pixel near the boundary to the nearest pixel centre of the other side, less
// half a pixel, positive inside; kSureColorReachPx + 0.5 farther away.
ImageF1 near_distance(ViewU8x1 matte) {
    const int w = matte.width(), h = matte.height();
    constexpr int kFar = kSureColorReachPx + 1;
    // Per pixel: steps along the row to the nearest pixel of the other side, up to kFar.
    Image<std::uint8_t, 1> to_in(matte.size(), kFar), to_out(matte.size(), kFar);
    ImageF1 phi(matte.size());
    parallel_rows(h, 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const std::uint8_t* m = matte.row(y);
            std::uint8_t* in = to_in.row(y);
            std::uint8_t* out = to_out.row(y);
            int last_in = -kFar, last_out = -kFar;
            for (int x = 0; x < w; ++x) {
                (m[x] >= 128 ? last_in : last_out) = x;
                in[x] = static_cast<std::uint8_t>(std::min(kFar, x - last_in));
                out[x] = static_cast<std::uint8_t>(std::min(kFar, x - last_out));
            }
            last_in = last_out = w + kFar;
            for (int x = w - 1; x >= 0; --x) {
                (m[x] >= 128 ? last_in : last_out) = x;
                in[x] = std::min(in[x], static_cast<std::uint8_t>(std::min(kFar, last_in - x)));
                out[x] = std::min(out[x], static_cast<std::uint8_t>(std::min(kFar, last_out - x)));
            }
        }
    });
    parallel_rows(h, 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            float* p = phi.row(y);
            for (int x = 0; x < w; ++x) {
                const bool inside = matte.row(y)[x] >= 128;
                const auto& other = inside ? to_out : to_in;
                int best = kFar * kFar;
                for (int v = std::max(0, y - kSureColorReachPx);
                     v <= std::min(h - 1, y + kSureColorReachPx); ++v) {
                    const int dx = other.row(v)[x];
                    if (dx < kFar) best = std::min(best, dx * dx + (v - y) * (v - y));
                }
                const float d = std::sqrt(static_cast<float>(best)) - 0.5f;
                p[x] = inside ? d : -d;
            }
        }
    });
    return phi;
}

// Coverage by the boundary's shape alone: the inside's share of a binomial 3×3 window.
float shape_coverage(ViewU8x1 matte, int x, int y) {
    constexpr int kWeights[3] = {1, 2, 1};
    int sum = 0;
    for (int j = -1; j <= 1; ++j) {
        const int v = std::clamp(y + j, 0, matte.height() - 1);
        for (int i = -1; i <= 1; ++i) {
            const int u = std::clamp(x + i, 0, matte.width() - 1);
            sum += kWeights[j + 1] * kWeights[i + 1] * (matte.row(v)[u] >= 128 ? 1 : 0);
        }
    }
    return static_cast<float>(sum) / 16;
}

float softened(ViewU8x3 plate, ViewU8x1 matte, ViewF1 phi, int x, int y, float width_px) {
    ColorSum inside, outside;
    for (int v = std::max(0, y - kSureColorReachPx);
         v <= std::min(plate.height() - 1, y + kSureColorReachPx); ++v) {
        for (int u = std::max(0, x - kSureColorReachPx);
             u <= std::min(plate.width() - 1, x + kSureColorReachPx); ++u) {
            const float d = phi.row(v)[u];
            const auto near = 1 / static_cast<float>(1 + (u - x) * (u - x) + (v - y) * (v - y));
            if (d > width_px) inside.add(plate.pixel(u, v), near);
            if (d < -kOutsideClear) outside.add(plate.pixel(u, v), near);
        }
    }
    const float shape = shape_coverage(matte, x, y);
    if (inside.n <= 0 || outside.n <= 0) return shape;
    const std::uint8_t* p = plate.pixel(x, y);
    const MixEstimate mix = estimate_mix(Vec3(p[0], p[1], p[2]), inside.mean(), inside.variance(),
                                         outside.mean(), outside.variance());
    return shape + mix.reliability * (mix.coverage - shape);
}

}  // namespace

float edge_hardness(ViewU8x1 matte) {
    // A soft outline has about one partial pixel per step of boundary. A hard one may have a few,
    // from compression or a stray stroke.
    std::int64_t partial = 0, steps = 0;
    for (int y = 0; y < matte.height(); ++y) {
        const std::uint8_t* row = matte.row(y);
        const std::uint8_t* below = y + 1 < matte.height() ? matte.row(y + 1) : row;
        for (int x = 0; x < matte.width(); ++x) {
            partial += row[x] > 8 && row[x] < 247 ? 1 : 0;
            const int right = x + 1 < matte.width() ? row[x + 1] : row[x];
            steps += std::abs(right - row[x]) > 238 ? 1 : 0;
            steps += std::abs(below[x] - row[x]) > 238 ? 1 : 0;
        }
    }
    if (partial * 10 <= steps) return 1;
    if (partial * 10 >= 3 * steps) return 0;
    return static_cast<float>(3 * steps - 10 * partial) / static_cast<float>(2 * steps);
}

Matte soften_hard_edge(ViewU8x3 plate, ViewU8x1 matte, float width_px) {
    Matte result(matte.size());
    const ImageF1 phi = near_distance(matte);
    parallel_rows(matte.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < matte.width(); ++x) {
                const std::uint8_t m = matte.row(y)[x];
                const float d = phi.row(y)[x];
                std::uint8_t& out = result.row(y)[x];
                out = m;
                if (d <= 0 || d >= width_px) continue;
                const float coverage = softened(plate, matte, phi, x, y, width_px);
                out = std::min(m, static_cast<std::uint8_t>(coverage * 255 + 0.5f));
            }
        }
    });
    return result;
}

}  // namespace weft
