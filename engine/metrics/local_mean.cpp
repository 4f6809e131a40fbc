#include "engine/metrics/local_mean.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kMeanSigmaPx = 8.0f;
constexpr int kRadiusPx = 24;  // Three σ.
constexpr float kFloorLevels = 4.0f;

std::vector<float> gaussian() {
    std::vector<float> w(2 * kRadiusPx + 1);
    for (int i = -kRadiusPx; i <= kRadiusPx; ++i) {
        const float t = static_cast<float>(i) / kMeanSigmaPx;
        w[static_cast<std::size_t>(i + kRadiusPx)] = std::exp(-0.5f * t * t);
    }
    return w;
}

// Σ w Y and Σ w over the region, along x and then along y.
Image<float, 2> weighted_sums(ViewF1 luma, ViewU8x1 inside) {
    const std::vector<float> g = gaussian();
    const int w = luma.width();
    const int h = luma.height();
    Image<float, 2> along_x(luma.size());
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x) {
                if (inside.row(y)[x] == 0) continue;
                const float v = luma.row(y)[x];
                const int u1 = std::min(w - 1, x + kRadiusPx);
                for (int u = std::max(0, x - kRadiusPx); u <= u1; ++u) {
                    const float k = g[static_cast<std::size_t>(u - x + kRadiusPx)];
                    along_x.pixel(u, y)[0] += k * v;
                    along_x.pixel(u, y)[1] += k;
                }
            }
        }
    });
    Image<float, 2> out(luma.size());
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            float* o = out.row(y);
            for (int v = std::max(0, y - kRadiusPx); v <= std::min(h - 1, y + kRadiusPx); ++v) {
                const float k = g[static_cast<std::size_t>(v - y + kRadiusPx)];
                const float* r = along_x.row(v);
                for (int i = 0; i < 2 * w; ++i)
                    o[i] += k * r[i];
            }
        }
    });
    return out;
}

}  // namespace

ImageF1 divided_by_local_mean(ViewF1 luma, ViewU8x1 inside) {
    const Image<float, 2> sums = weighted_sums(luma, inside);
    ImageF1 out(luma.size());
    for (int y = 0; y < luma.height(); ++y) {
        for (int x = 0; x < luma.width(); ++x) {
            if (inside.row(y)[x] == 0) continue;
            const float* s = sums.pixel(x, y);
            out.row(y)[x] = luma.row(y)[x] / (s[0] / s[1] + kFloorLevels);
        }
    }
    return out;
}

}  // namespace weft
