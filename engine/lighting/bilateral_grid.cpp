#include "engine/lighting/bilateral_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/lighting/fast_math.h"

namespace weft {
namespace {

// Splat and slice are trilinear (variance 1/6 cell² each), the blur is [1 2 1]/4 (1/2 cell²).
constexpr float kSigmaInCells = 0.9129f;
constexpr int kMaxBins = 96;
constexpr float kMinWeight = 1e-4f;
// A grid that is as fine as the picture costs more than sums over the few neighbours.
constexpr float kDirectPx = 1.5f;
constexpr float kDirectSigmas = 2.2f;
constexpr float kLeastPx = 0.7f;

struct Grid {
    int width = 0, height = 0, depth = 0;  // cells, borders included
    float cells_per_px = 1, bins_per_unit = 1, lowest = 0;
    std::vector<float> cells;  // (value, weight) pairs; depth fastest, then x, then y

    [[nodiscard]] std::ptrdiff_t x_step() const { return 2 * static_cast<std::ptrdiff_t>(depth); }
    [[nodiscard]] std::ptrdiff_t y_step() const { return x_step() * width; }
    // Position of the first cell centre at or before the point, and how far the point is past it.
    [[nodiscard]] float space(int pixel) const {
        return (static_cast<float>(pixel) + 0.5f) * cells_per_px + 0.5f;
    }
    [[nodiscard]] float bin(float guide) const {
        return std::clamp((guide - lowest) * bins_per_unit + 1.0f, 0.0f,
                          static_cast<float>(depth) - 1.001f);
    }
};

Grid make_grid(const ImageF1& weight, const ImageF1& guide, const BilateralScale& scale) {
    float lowest = std::numeric_limits<float>::max(), highest = -lowest;
    for (int y = 0; y < guide.height(); ++y) {
        for (int x = 0; x < guide.width(); ++x) {
            if (weight.row(y)[x] == 0) continue;
            lowest = std::min(lowest, guide.row(y)[x]);
            highest = std::max(highest, guide.row(y)[x]);
        }
    }
    Grid g;
    if (lowest > highest) return g;
    g.lowest = lowest;
    g.cells_per_px = kSigmaInCells / std::max(1.0f, scale.space_px);
    g.bins_per_unit = std::min(kSigmaInCells / scale.range,
                               static_cast<float>(kMaxBins) / std::max(1e-6f, highest - lowest));
    g.depth = static_cast<int>((highest - lowest) * g.bins_per_unit) + 4;
    g.width = static_cast<int>(g.space(guide.width() - 1)) + 2;
    g.height = static_cast<int>(g.space(guide.height() - 1)) + 2;
    g.cells.assign(static_cast<std::size_t>(g.y_step()) * static_cast<std::size_t>(g.height), 0.0f);
    return g;
}

// The rows of pixels that splat into cell rows j and j + 1.
void splat_rows(Grid& g, int y, const ImageF1& values, const ImageF1& weight,
                const ImageF1& guide) {
    const float gy = g.space(y);
    const int j = static_cast<int>(gy);
    const float fy = gy - static_cast<float>(j);
    float* row = g.cells.data() + j * g.y_step();
    for (int x = 0; x < guide.width(); ++x) {
        const float w = weight.row(y)[x];
        if (w == 0) continue;
        const float gx = g.space(x), gz = g.bin(guide.row(y)[x]);
        const int i = static_cast<int>(gx), k = static_cast<int>(gz);
        const float fx = gx - static_cast<float>(i), fz = gz - static_cast<float>(k);
        const float v = values.row(y)[x];
        float* cell = row + i * g.x_step() + 2 * k;
        const auto add = [&](float* c, float share) {
            const float near = share * (1.0f - fz), far = share * fz;
            c[0] += near * v, c[1] += near * w, c[2] += far * v, c[3] += far * w;
        };
        add(cell, (1.0f - fx) * (1.0f - fy));
        add(cell + g.x_step(), fx * (1.0f - fy));
        add(cell + g.y_step(), (1.0f - fx) * fy);
        add(cell + g.y_step() + g.x_step(), fx * fy);
    }
}

// Bands of pixel rows that share a cell row j touch cell rows j and j + 1 only: all even ones run
// at once, then all odd ones, so that sums come in the same order for any number of threads.
void splat(Grid& g, const ImageF1& values, const ImageF1& weight, const ImageF1& guide) {
    std::vector<int> first_row(static_cast<std::size_t>(g.height) + 1, guide.height());
    for (int y = guide.height() - 1; y >= 0; --y)
        first_row[static_cast<std::size_t>(g.space(y))] = y;
    for (std::size_t j = static_cast<std::size_t>(g.height); j-- > 0;)
        first_row[j] = std::min(first_row[j], first_row[j + 1]);
    for (int parity = 0; parity < 2; ++parity) {
        parallel_for(static_cast<std::size_t>((g.height - parity + 1) / 2), [&](std::size_t half) {
            const std::size_t j = 2 * half + static_cast<std::size_t>(parity);
            for (int y = first_row[j]; y < first_row[j + 1]; ++y)
                splat_rows(g, y, values, weight, guide);
        });
    }
}

// [1 2 1]/4 over `count` runs of `length` floats, `step` floats apart, with 0 beyond the ends.
void blur_runs(const float* in, float* out, int count, std::ptrdiff_t step, std::ptrdiff_t length) {
    for (int i = 0; i < count; ++i) {
        const float* here = in + i * step;
        float* to = out + i * step;
        for (std::ptrdiff_t k = 0; k < length; ++k)
            to[k] = 0.5f * here[k];
        if (i > 0) {
            for (std::ptrdiff_t k = 0; k < length; ++k)
                to[k] += 0.25f * here[k - step];
        }
        if (i + 1 < count) {
            for (std::ptrdiff_t k = 0; k < length; ++k)
                to[k] += 0.25f * here[k + step];
        }
    }
}

void blur(Grid& g) {
    std::vector<float> other(g.cells.size());
    parallel_rows(g.height, 2, [&](int j0, int j1) {
        for (int j = j0; j < j1; ++j) {
            float* a = g.cells.data() + j * g.y_step();
            float* b = other.data() + j * g.y_step();
            for (int i = 0; i < g.width; ++i)
                blur_runs(a + i * g.x_step(), b + i * g.x_step(), g.depth, 2, 2);
            blur_runs(b, a, g.width, g.x_step(), g.x_step());
        }
    });
    parallel_rows(g.height, 2, [&](int j0, int j1) {
        for (int j = j0; j < j1; ++j) {
            const float* here = g.cells.data() + j * g.y_step();
            const float* above = j > 0 ? here - g.y_step() : nullptr;
            const float* below = j + 1 < g.height ? here + g.y_step() : nullptr;
            float* to = other.data() + j * g.y_step();
            for (std::ptrdiff_t k = 0; k < g.y_step(); ++k)
                to[k] = 0.5f * here[k];
            for (const float* side : {above, below}) {
                if (!side) continue;
                for (std::ptrdiff_t k = 0; k < g.y_step(); ++k)
                    to[k] += 0.25f * side[k];
            }
        }
    });
    g.cells.swap(other);
}

void slice_row(const Grid& g, int y, const ImageF1& guide, float* out) {
    const float gy = g.space(y);
    const int j = static_cast<int>(gy);
    const float fy = gy - static_cast<float>(j);
    const float* row = g.cells.data() + j * g.y_step();
    for (int x = 0; x < guide.width(); ++x) {
        const float own = guide.row(y)[x];
        const float gx = g.space(x), gz = g.bin(own);
        const int i = static_cast<int>(gx), k = static_cast<int>(gz);
        const float fx = gx - static_cast<float>(i), fz = gz - static_cast<float>(k);
        const float* c = row + i * g.x_step() + 2 * k;
        float value = 0, weight = 0;
        const auto take = [&](const float* p, float share) {
            value += share * ((1.0f - fz) * p[0] + fz * p[2]);
            weight += share * ((1.0f - fz) * p[1] + fz * p[3]);
        };
        take(c, (1.0f - fx) * (1.0f - fy));
        take(c + g.x_step(), fx * (1.0f - fy));
        take(c + g.y_step(), (1.0f - fx) * fy);
        take(c + g.y_step() + g.x_step(), fx * fy);
        out[x] = weight > kMinWeight ? value / weight : own;
    }
}

// The sums of one row over its neighbours, as the definition says.
void direct_row(const ImageF1& values, const ImageF1& weight, const ImageF1& guide,
                const BilateralScale& scale, int y, float* out) {
    const float space_px = std::max(kLeastPx, scale.space_px);
    const int width = guide.width();
    const int radius = std::max(1, static_cast<int>(kDirectSigmas * space_px));
    const float per_space = -0.5f / (space_px * space_px);
    const float per_range = -0.5f / (scale.range * scale.range);
    const float* own = guide.row(y);
    std::vector<float> value(static_cast<std::size_t>(width)), total(value.size());
    for (int v = std::max(0, y - radius); v <= std::min(guide.height() - 1, y + radius); ++v) {
        for (int dx = -radius; dx <= radius; ++dx) {
            const auto far = static_cast<float>(dx * dx + (v - y) * (v - y));
            const float near = fast_exp(per_space * far);
            const float *g = guide.row(v) + dx, *n = values.row(v) + dx, *w = weight.row(v) + dx;
            for (int x = std::max(0, -dx); x < width - std::max(0, dx); ++x) {
                const float d = g[x] - own[x];
                const float share = near * fast_exp(per_range * d * d);
                value[static_cast<std::size_t>(x)] += share * n[x];
                total[static_cast<std::size_t>(x)] += share * w[x];
            }
        }
    }
    for (int x = 0; x < width; ++x) {
        const auto i = static_cast<std::size_t>(x);
        out[x] = total[i] > kMinWeight ? value[i] / total[i] : own[x];
    }
}

}  // namespace

ImageF1 joint_bilateral(const ImageF1& weighted_values, const ImageF1& weight, const ImageF1& guide,
                        const BilateralScale& scale) {
    ImageF1 out(guide.size());
    if (scale.space_px <= kDirectPx) {
        parallel_rows(guide.height(), 16, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y)
                direct_row(weighted_values, weight, guide, scale, y, out.row(y));
        });
        return out;
    }
    Grid g = make_grid(weight, guide, scale);
    if (g.cells.empty()) return guide;
    splat(g, weighted_values, weight, guide);
    blur(g);
    parallel_rows(guide.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y)
            slice_row(g, y, guide, out.row(y));
    });
    return out;
}

}  // namespace weft
