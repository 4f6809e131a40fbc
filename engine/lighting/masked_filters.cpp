#include "engine/lighting/masked_filters.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kBand = 16;
constexpr int kStrip = 64;  // columns that one task blurs vertically

void blur_rows(ImageF1& plane, int radius) {
    const int n = plane.width();
    const float scale = 1.0f / static_cast<float>(2 * radius + 1);
    parallel_rows(plane.height(), kBand, [&](int y0, int y1) {
        std::vector<float> padded(static_cast<std::size_t>(n + 2 * radius + 1), 0.0f);
        for (int y = y0; y < y1; ++y) {
            float* row = plane.row(y);
            std::copy(row, row + n, padded.begin() + radius + 1);
            float sum = 0;
            for (int i = 0; i < 2 * radius + 1; ++i)
                sum += padded[static_cast<std::size_t>(i)];
            const float* leaving = padded.data();
            const float* entering = leaving + 2 * radius + 1;
            for (int x = 0; x < n; ++x) {
                sum += entering[x] - leaving[x];
                row[x] = sum * scale;
            }
        }
    });
}

void blur_columns(ImageF1& plane, int radius) {
    const int h = plane.height();
    const float scale = 1.0f / static_cast<float>(2 * radius + 1);
    parallel_rows(plane.width(), kStrip, [&](int x0, int x1) {
        const int n = x1 - x0;
        const auto cells = static_cast<std::size_t>(n) * static_cast<std::size_t>(h);
        std::vector<float> source(cells), sums(static_cast<std::size_t>(n), 0.0f);
        for (int y = 0; y < h; ++y)
            std::copy(plane.row(y) + x0, plane.row(y) + x1,
                      source.data() + static_cast<std::ptrdiff_t>(y) * n);
        float* sum = sums.data();
        const auto add_row = [&](int y, float sign) {
            if (y < 0 || y >= h) return;
            const float* s = source.data() + static_cast<std::ptrdiff_t>(y) * n;
            for (int x = 0; x < n; ++x)
                sum[x] += sign * s[x];
        };
        for (int y = 0; y < radius; ++y)
            add_row(y, 1.0f);
        for (int y = 0; y < h; ++y) {
            add_row(y + radius, 1.0f);
            add_row(y - radius - 1, -1.0f);
            float* out = plane.row(y) + x0;
            for (int x = 0; x < n; ++x)
                out[x] = sum[x] * scale;
        }
    });
}

// Half the size, weighted; 2×2 blocks.
void push(const ImageF1& plane, const ImageF1& weight, ImageF1& small, ImageF1& small_weight) {
    parallel_rows(small.height(), kBand, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < small.width(); ++x) {
                float sum = 0, total = 0;
                for (int v = 2 * y; v < std::min(plane.height(), 2 * y + 2); ++v) {
                    for (int u = 2 * x; u < std::min(plane.width(), 2 * x + 2); ++u) {
                        sum += plane.row(v)[u] * weight.row(v)[u];
                        total += weight.row(v)[u];
                    }
                }
                small.row(y)[x] = total > 0 ? sum / total : 0.0f;
                small_weight.row(y)[x] = std::min(1.0f, total);
            }
        }
    });
}

float bilinear(const ImageF1& plane, float x, float y) {
    x = std::clamp(x, 0.0f, static_cast<float>(plane.width() - 1));
    y = std::clamp(y, 0.0f, static_cast<float>(plane.height() - 1));
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, plane.width() - 1), y1 = std::min(y0 + 1, plane.height() - 1);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const float top = plane.row(y0)[x0] + fx * (plane.row(y0)[x1] - plane.row(y0)[x0]);
    const float low = plane.row(y1)[x0] + fx * (plane.row(y1)[x1] - plane.row(y1)[x0]);
    return top + fy * (low - top);
}

void fill(ImageF1& plane, const ImageF1& weight) {
    if (plane.width() <= 1 && plane.height() <= 1) return;
    const Size half{(plane.width() + 1) / 2, (plane.height() + 1) / 2};
    ImageF1 small(half), small_weight(half);
    push(plane, weight, small, small_weight);
    fill(small, small_weight);
    parallel_rows(plane.height(), kBand, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            float* row = plane.row(y);
            const float* w = weight.row(y);
            for (int x = 0; x < plane.width(); ++x) {
                if (w[x] >= 1.0f) continue;
                const float coarse = bilinear(small, (static_cast<float>(x) - 0.5f) * 0.5f,
                                              (static_cast<float>(y) - 0.5f) * 0.5f);
                row[x] = w[x] * row[x] + (1.0f - w[x]) * coarse;
            }
        }
    });
}

}  // namespace

void box_blur(ImageF1& plane, int radius_px) {
    if (radius_px <= 0 || plane.empty()) return;
    blur_rows(plane, radius_px);
    blur_columns(plane, radius_px);
}

void gaussian_blur(ImageF1& plane, float sigma_px) {
    // A box of 2r + 1 has variance r (r + 1) / 3; three of them, of radii that differ by at most
    // one.
    constexpr int kPasses = 3;
    const float variance = sigma_px * sigma_px;
    const auto of = [](int r) { return static_cast<float>(r * (r + 1)) / 3.0f; };
    int low = 0;
    while (kPasses * of(low + 1) <= variance)
        ++low;
    const float excess = (variance - kPasses * of(low)) / (of(low + 1) - of(low));
    const int wider = std::clamp(static_cast<int>(excess + 0.5f), 0, kPasses);
    for (int i = 0; i < kPasses; ++i)
        box_blur(plane, i < wider ? low + 1 : low);
}

ImageF1 weighted(const ImageF1& plane, const ImageF1& weight) {
    ImageF1 out(plane.size());
    const std::size_t n = plane.size_bytes() / sizeof(float);
    for (std::size_t i = 0; i < n; ++i)
        out.data()[i] = plane.data()[i] * weight.data()[i];
    return out;
}

void fill_unknown(ImageF1& plane, const Matte& known) {
    ImageF1 weight(plane.size());
    for (std::size_t i = 0; i < known.size_bytes(); ++i) {
        weight.data()[i] = known.data()[i] ? 1.0f : 0.0f;
        if (!known.data()[i]) plane.data()[i] = 0;
    }
    fill(plane, weight);
}

ImageF1 high_pass(const ImageF1& plane, const ImageF1& weight, const ImageF1& weight_mean,
                  int window) {
    ImageF1 mean = weighted(plane, weight);
    box_blur(mean, window);
    parallel_rows(plane.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            float* m = mean.row(y);
            const float* total = weight_mean.row(y);
            for (int x = 0; x < plane.width(); ++x)
                m[x] = plane.row(y)[x] - m[x] / std::max(total[x], kLeastWeight);
        }
    });
    return mean;
}

}  // namespace weft
