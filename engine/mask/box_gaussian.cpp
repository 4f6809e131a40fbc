#include "engine/mask/box_gaussian.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kNothing_px = 0.05f;
constexpr int kPasses = 3;
constexpr int kBlock = 32;  // columns that are filtered at once

// A box of 2 r + 1 whole samples and one at either end that counts `end`, 0–1.
struct Box {
    int r = 0;
    double end = 0;
    [[nodiscard]] double size() const { return 2 * r + 1 + 2 * end; }
};

// The box of which `kPasses` have the variance σ² (Gwosdek et al. 2011, eq. 6).
Box box_of(float sigma_px) {
    const double variance = static_cast<double>(sigma_px) * sigma_px / kPasses;
    Box box;
    box.r = static_cast<int>((std::sqrt(12 * variance + 1) - 1) / 2);
    const double r = box.r;
    box.end = (2 * r + 1) * (r * (r + 1) - 3 * variance) / (6 * (variance - (r + 1) * (r + 1)));
    return box;
}

// One pass over `n` samples of `kBlock` lines side by side, from `in` to `out`; both are n ×
// kBlock.
void pass(const std::vector<float>& in, std::vector<float>& out, int n, const Box& box) {
    const auto line = [&](int i) {
        return in.data() + static_cast<std::ptrdiff_t>(std::clamp(i, 0, n - 1)) * kBlock;
    };
    std::array<double, kBlock> sum{};
    for (int i = -box.r; i <= box.r; ++i)
        for (int c = 0; c < kBlock; ++c)
            sum[static_cast<std::size_t>(c)] += static_cast<double>(line(i)[c]);
    const double scale = 1 / box.size();
    for (int i = 0; i < n; ++i) {
        const float* before = line(i - box.r - 1);
        const float* after = line(i + box.r + 1);
        const float* first = line(i - box.r);
        float* to = out.data() + static_cast<std::ptrdiff_t>(i) * kBlock;
        for (int c = 0; c < kBlock; ++c) {
            double& s = sum[static_cast<std::size_t>(c)];
            const auto a = static_cast<double>(before[c]), b = static_cast<double>(after[c]);
            to[c] = static_cast<float>((s + box.end * (a + b)) * scale);
            s += b - static_cast<double>(first[c]);
        }
    }
}

// All passes along columns.
void filter_columns(ImageF1& image, const Box& box) {
    const int w = image.width(), h = image.height();
    const auto blocks = static_cast<std::size_t>((w + kBlock - 1) / kBlock);
    parallel_for(blocks, [&](std::size_t block) {
        const int x0 = static_cast<int>(block) * kBlock, count = std::min(kBlock, w - x0);
        std::vector<float> a(static_cast<std::size_t>(h) * kBlock), b(a.size());
        for (int y = 0; y < h; ++y)
            std::copy_n(image.row(y) + x0, count,
                        a.data() + static_cast<std::ptrdiff_t>(y) * kBlock);
        for (int k = 0; k < kPasses; ++k) {
            pass(a, b, h, box);
            std::swap(a, b);
        }
        for (int y = 0; y < h; ++y)
            std::copy_n(a.data() + static_cast<std::ptrdiff_t>(y) * kBlock, count,
                        image.row(y) + x0);
    });
}

// All passes along rows, kBlock rows at once.
void filter_rows(ImageF1& image, const Box& box) {
    const int w = image.width(), h = image.height();
    parallel_rows(h, kBlock, [&](int y0, int y1) {
        std::vector<float> a(static_cast<std::size_t>(w) * kBlock), b(a.size());
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < w; ++x)
                a[static_cast<std::size_t>(x) * kBlock + static_cast<std::size_t>(y - y0)] =
                    image.row(y)[x];
        for (int k = 0; k < kPasses; ++k) {
            pass(a, b, w, box);
            std::swap(a, b);
        }
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < w; ++x)
                image.row(y)[x] =
                    a[static_cast<std::size_t>(x) * kBlock + static_cast<std::size_t>(y - y0)];
    });
}

}  // namespace

ImageF1 box_gaussian(ImageF1 image, float sigma_px) {
    if (!(sigma_px >= kNothing_px) || image.empty()) return image;
    const Box box = box_of(sigma_px);
    filter_rows(image, box);
    filter_columns(image, box);
    return image;
}

int box_gaussian_reach(float sigma_px) {
    return sigma_px >= kNothing_px ? kPasses * (box_of(sigma_px).r + 1) : 0;
}

}  // namespace weft
