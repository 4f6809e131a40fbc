#include "engine/core/blur_inside.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/core/parallel.h"

namespace weft {
namespace {

using F4 = float __attribute__((vector_size(16)));

}  // namespace

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
        // A row between borders of weight 0, which no sum notices.
        std::vector<F4> padded(static_cast<std::size_t>(w + 2 * r));
        for (int y = y0; y < y1; ++y) {
            const float* p = picture.row(y);
            const std::uint8_t* m = matte.row(y);
            for (int x = 0; x < w; ++x, p += 3)
                padded[static_cast<std::size_t>(x + r)] =
                    m[x] == 0 ? F4{} : F4{p[0], p[1], p[2], 1.0f};
            for (int x = 0; x < w; ++x) {
                const F4* from = padded.data() + x;
                F4 sum{};
                for (const float k : kernel)
                    sum += k * *from++;
                std::memcpy(rows.pixel(x, y), &sum, sizeof sum);
            }
        }
    });
    parallel_rows(h, 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const int first = std::max(0, y - r), last = std::min(h - 1, y + r);
            for (int x = 0; x < w; ++x) {
                if (matte.row(y)[x] == 0) continue;
                const float* from = rows.pixel(x, first);
                F4 sum{};
                for (int v = first; v <= last; ++v, from += rows.stride()) {
                    F4 there;
                    std::memcpy(&there, from, sizeof there);
                    sum += kernel[static_cast<std::size_t>(v - y + r)] * there;
                }
                for (int c = 0; c < 3; ++c)
                    picture.pixel(x, y)[c] = sum[c] / sum[3];
            }
        }
    });
}

}  // namespace weft
