#include "engine/lighting/surface_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/luma.h"
#include "engine/core/median.h"
#include "engine/core/parallel.h"
#include "engine/lighting/coverage.h"
#include "engine/lighting/fast_math.h"

namespace weft {
namespace {

constexpr float kRimWeight = 0.02f;  // enough to fill regions that are all rim
constexpr int kMargin = 2;           // small pixels around the matte's box
constexpr float kFloorOfMedian = 0.02f, kLeastFloorOfMedian = 0.002f;
constexpr float kFloorOfDark = 0.5f;  // times the upper end of the darkest tenth

// The box of covered pixels, in plate pixels.
Recti covered_box(ViewU8x1 visible) {
    std::vector<Recti> rows(static_cast<std::size_t>(visible.height()));
    parallel_rows(visible.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const std::uint8_t* m = visible.row(y);
            const auto covered = [](std::uint8_t v) { return v >= kCoveredFrom; };
            const std::uint8_t* end = m + visible.width();
            const std::uint8_t* first = std::find_if(m, end, covered);
            if (first == end) continue;
            while (!covered(end[-1]))
                --end;
            rows[static_cast<std::size_t>(y)] = {static_cast<int>(first - m), y,
                                                 static_cast<int>(end - m), y + 1};
        }
    });
    Recti box;
    for (const Recti& r : rows)
        box = box.united(r);
    return box;
}

// Weights of the pixels of row y in [x0, x1): 1 inside, kRimWeight at the rim, 0 outside.
void weights_of_row(ViewU8x1 visible, int y, int x0, int x1, std::vector<std::uint8_t>& column_min,
                    float* weights) {
    const std::uint8_t* above = visible.row(std::max(0, y - 1));
    const std::uint8_t* here = visible.row(y);
    const std::uint8_t* below = visible.row(std::min(visible.height() - 1, y + 1));
    const int a = std::max(0, x0 - 1);
    const int b = std::min(visible.width(), x1 + 1);
    std::uint8_t* lowest = column_min.data();
    for (int x = a; x < b; ++x)
        lowest[x] = std::min(std::min(above[x], below[x]), here[x]);
    for (int x = x0; x < x1; ++x) {
        const int around = std::min(std::min(lowest[std::max(a, x - 1)], lowest[x]),
                                    lowest[std::min(b - 1, x + 1)]);
        const bool sure = here[x] >= kUnmixedFrom && around >= kCoveredFrom;
        weights[x - x0] = here[x] < kCoveredFrom ? 0.0f : sure ? 1.0f : kRimWeight;
    }
}

// Mean colour and weight of every block; R, G, B are stored in the sample's planes for now.
void average_blocks(ViewF3 linear, ViewU8x1 visible, int d, SurfaceSample& s) {
    const int full_x0 = s.box.x0 * d;
    const int full_x1 = std::min(linear.width(), s.box.x1 * d);
    const float per_block = 1.0f / static_cast<float>(d * d);
    parallel_rows(s.box.height(), 8, [&](int y0, int y1) {
        std::vector<std::uint8_t> column_min(static_cast<std::size_t>(linear.width()));
        std::vector<float> weights(static_cast<std::size_t>(full_x1 - full_x0));
        for (int y = y0; y < y1; ++y) {
            float *w = s.weight.row(y), *r = s.red_green.row(y);
            float *g = s.luma.row(y), *b = s.blue_green.row(y);
            const int top = (s.box.y0 + y) * d;
            for (int fy = top; fy < std::min(linear.height(), top + d); ++fy) {
                weights_of_row(visible, fy, full_x0, full_x1, column_min, weights.data());
                const float* p = linear.pixel(full_x0, fy);
                const float* t = weights.data();
                const float* end = t + (full_x1 - full_x0);
                for (int i = 0; t < end; ++i) {
                    for (const float* last = std::min(end, t + d); t < last; ++t, p += 3) {
                        if (*t == 0 || !std::isfinite(p[0] + p[1] + p[2])) continue;
                        w[i] += *t;
                        r[i] += *t * std::max(0.0f, p[0]);
                        g[i] += *t * std::max(0.0f, p[1]);
                        b[i] += *t * std::max(0.0f, p[2]);
                    }
                }
            }
            for (int x = 0; x < s.box.width(); ++x) {
                if (w[x] == 0) continue;
                const float scale = 1.0f / w[x];
                r[x] *= scale, g[x] *= scale, b[x] *= scale, w[x] *= per_block;
            }
        }
    });
}

// A small part of the surface's luminance, so that it scales with the exposure.
float floor_of(const SurfaceSample& s) {
    std::vector<float> values;
    for (int y = 0; y < s.box.height(); ++y) {
        for (int x = 0; x < s.box.width(); ++x) {
            if (s.weight.row(y)[x] == 0) continue;
            values.push_back(
                luma_709(s.red_green.row(y)[x], s.luma.row(y)[x], s.blue_green.row(y)[x]));
        }
    }
    const float median = median_of(values, 0.0f);
    // In scene-linear light, shade may be a hundredth of a sunlit area.
    const auto dark = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 10);
    float limit = median;
    if (dark != values.end()) {
        std::nth_element(values.begin(), dark, values.end());
        limit = *dark;
    }
    const float floor = std::min(kFloorOfMedian * median, kFloorOfDark * limit);
    return std::max(1e-6f, std::max(floor, kLeastFloorOfMedian * median));
}

}  // namespace

SurfaceSample sample_surface(ViewF3 linear, ViewU8x1 visible, int downscale) {
    SurfaceSample s;
    s.downscale = downscale;
    s.full = linear.size();
    const Recti full = covered_box(visible);
    if (full.empty()) return s;
    const int d = downscale;
    const Recti small{full.x0 / d, full.y0 / d, (full.x1 + d - 1) / d, (full.y1 + d - 1) / d};
    s.box = small.grown(kMargin).intersected(rect_of(reduced_size(linear.size(), d)));
    s.weight = s.luma = s.red_green = s.blue_green = ImageF1(s.box.size());
    average_blocks(linear, visible, d, s);
    s.floor = floor_of(s);
    parallel_rows(s.box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < s.box.width(); ++x) {
                if (s.weight.row(y)[x] == 0) continue;
                float &r = s.red_green.row(y)[x], &g = s.luma.row(y)[x],
                      &b = s.blue_green.row(y)[x];
                const float log_green = fast_log(g + s.floor);
                const float y_linear = luma_709(r, g, b);
                r = fast_log(r + s.floor) - log_green;
                b = fast_log(b + s.floor) - log_green;
                g = fast_log(y_linear + s.floor);
            }
        }
    });
    return s;
}

ImageF1 painted_luma(const SurfaceSample& sample) {
    ImageF1 out = sample.luma;
    for (std::size_t i = 0; i < sample.daylight.size_bytes() / sizeof(float); ++i)
        out.data()[i] -= sample.daylight.data()[i];
    return out;
}

ImageF1 undecided_luma(const SurfaceSample& sample) {
    ImageF1 out = painted_luma(sample);
    for (std::size_t i = 0; i < sample.paint.size_bytes() / sizeof(float); ++i)
        out.data()[i] -= sample.paint.data()[i];
    return out;
}

}  // namespace weft
