#include "engine/core/blur_inside.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"

namespace weft {

std::vector<float> gaussian_kernel(float sigma) {
    const int radius = std::max(1, static_cast<int>(std::ceil(3.0f * sigma)));
    std::vector<float> kernel(static_cast<std::size_t>(2 * radius + 1));
    float sum = 0;
    for (int k = -radius; k <= radius; ++k) {
        const float r = static_cast<float>(k) / sigma;
        sum += kernel[static_cast<std::size_t>(k + radius)] = std::exp(-0.5f * r * r);
    }
    for (float& k : kernel)
        k /= sum;
    return kernel;
}

void blur_inside(ImageView<float, 3> picture, ViewU8x1 matte, float sigma_px) {
    constexpr float kLeastBlur = 0.2f;
    if (!(sigma_px >= kLeastBlur) || picture.empty()) return;
    const std::vector<float> kernel = gaussian_kernel(sigma_px);
    const int r = static_cast<int>(kernel.size() / 2);
    const int w = picture.width(), h = picture.height();
    Image<float, 4> rows(w, h);  // colour times weight, weight
    parallel_rows(h, 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x) {
                float* to = rows.pixel(x, y);
                for (int u = std::max(0, x - r); u <= std::min(w - 1, x + r); ++u) {
                    if (matte.row(y)[u] == 0) continue;
                    const float k = kernel[static_cast<std::size_t>(u - x + r)];
                    const float* p = picture.pixel(u, y);
                    to[0] += k * p[0], to[1] += k * p[1], to[2] += k * p[2], to[3] += k;
                }
            }
        }
    });
    parallel_rows(h, 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x) {
                if (matte.row(y)[x] == 0) continue;
                float sum[4] = {0, 0, 0, 0};
                for (int v = std::max(0, y - r); v <= std::min(h - 1, y + r); ++v) {
                    const float k = kernel[static_cast<std::size_t>(v - y + r)];
                    for (int c = 0; c < 4; ++c)
                        sum[c] += k * rows.pixel(x, v)[c];
                }
                for (int c = 0; c < 3; ++c)
                    picture.pixel(x, y)[c] = sum[c] / sum[3];
            }
        }
    });
}

}  // namespace weft
