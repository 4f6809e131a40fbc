#include "engine/metrics/truth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/color/color_space.h"
#include "engine/core/blur_inside.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/metrics/region.h"

namespace weft {
namespace {

constexpr double kShade = 0.6;    // of the median luminance: below this is a cast shadow
constexpr int kShadeOpening = 2;  // px: specks are not shadows

ImageF3 to_linear(ViewF3 encoded) {
    ImageF3 out(encoded.size());
    parallel_rows(encoded.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int i = 0; i < 3 * encoded.width(); ++i)
                out.row(y)[i] = srgb_to_linear(std::max(0.0f, encoded.row(y)[i]));
        }
    });
    return out;
}

double median_inside(const ImageF3& linear, ViewU8x1 matte) {
    std::vector<float> values;
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            if (matte.row(y)[x] >= kInsideCoverage) values.push_back(luma_709(linear.pixel(x, y)));
        }
    }
    if (values.empty()) return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
}

// 255 where the whole square around is (erosion), or any of it (dilation).
Matte spread(const Matte& m, bool all) {
    Matte out(m.size());
    for (int y = 0; y < m.height(); ++y) {
        for (int x = 0; x < m.width(); ++x) {
            bool any = false, every = true;
            for (int v = -kShadeOpening; v <= kShadeOpening; ++v) {
                for (int u = -kShadeOpening; u <= kShadeOpening; ++u) {
                    const bool set =
                        m.row(std::clamp(y + v, 0,
                                         m.height() - 1))[std::clamp(x + u, 0, m.width() - 1)] != 0;
                    any |= set, every &= set;
                }
            }
            out.row(y)[x] = (all ? every : any) ? 255 : 0;
        }
    }
    return out;
}

Matte shade_of(const ImageF3& truth, ViewU8x1 matte) {
    const double lit = median_inside(truth, matte);
    Matte dark(truth.size());
    for (int y = 0; y < dark.height(); ++y) {
        for (int x = 0; x < dark.width(); ++x) {
            if (matte.row(y)[x] >= kInsideCoverage &&
                static_cast<double>(luma_709(truth.pixel(x, y))) < kShade * lit)
                dark.row(y)[x] = 255;
        }
    }
    return spread(spread(dark, true), false);
}

// The new material's own colour at a soft pixel: that of unmixed pixels inside near by. False if
// there are none.
bool colour_near(const ImageF3& linear, ViewU8x1 matte, int x, int y, double* colour) {
    constexpr int kReach = 4;                // px
    constexpr double kVariance = 1.5 * 1.5;  // px²
    double sum[3] = {0, 0, 0}, weight = 0;
    for (int v = std::max(0, y - kReach); v <= std::min(matte.height() - 1, y + kReach); ++v) {
        for (int u = std::max(0, x - kReach); u <= std::min(matte.width() - 1, x + kReach); ++u) {
            const float* p = linear.pixel(u, v);
            if (matte.row(v)[u] < kInsideCoverage || !std::isfinite(p[0] + p[1] + p[2])) continue;
            const double far = (u - x) * (u - x) + (v - y) * (v - y);
            const double w = std::exp(-0.5 * far / kVariance);
            for (int c = 0; c < 3; ++c)
                sum[c] += w * static_cast<double>(p[c]);
            weight += w;
        }
    }
    if (!(weight > 0)) return false;
    for (int c = 0; c < 3; ++c)
        colour[c] = sum[c] / weight;
    return true;
}

// The picture with the new material brighter by `gain`: of a soft pixel M T + (1 − M) G only T gets
// the gain, not the background.
void brighten_material(ImageF3& linear, ViewU8x1 matte, const double (&gain)[3]) {
    const ImageF3 before = linear;
    parallel_rows(linear.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < linear.width(); ++x) {
                const int m = matte.row(y)[x];
                if (m == 0) continue;
                float* p = linear.pixel(x, y);
                double material[3] = {p[0], p[1], p[2]};
                if (m < kInsideCoverage) colour_near(before, matte, x, y, material);
                for (int c = 0; c < 3; ++c) {
                    const double more = m / 255.0 * (gain[c] - 1.0) * material[c];
                    p[c] = static_cast<float>(std::max(0.0, static_cast<double>(p[c]) + more));
                }
            }
        }
    });
}

struct Mean {
    double sum = 0;
    std::int64_t count = 0;
    void add(double v) { sum += v, ++count; }
    [[nodiscard]] std::optional<double> value() const {
        if (count == 0) return std::nullopt;
        return sum / static_cast<double>(count);
    }
};

}  // namespace

void TruthComparison::gather(ViewF3 result, ViewF3 truth, ViewU8x1 matte) {
    const ImageF3 r = to_linear(result), t = to_linear(truth);
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            if (matte.row(y)[x] < kInsideCoverage) continue;
            const float *p = r.pixel(x, y), *q = t.pixel(x, y);
            if (!std::isfinite(p[0] + p[1] + p[2] + q[0] + q[1] + q[2])) continue;
            for (int c = 0; c < 3; ++c)
                result_sum_[c] += static_cast<double>(p[c]),
                    truth_sum_[c] += static_cast<double>(q[c]);
        }
    }
    for (int c = 0; c < 3; ++c)
        gain_[c] = result_sum_[c] > 0 ? truth_sum_[c] / result_sum_[c] : 1.0;
}

TruthComparison::Frame TruthComparison::compare(ViewF3 result, ViewF3 truth, ViewU8x1 matte) {
    ImageF3 r = to_linear(result), t = to_linear(truth);
    Frame out;
    const double bright = median_inside(r, matte), true_bright = median_inside(t, matte);
    if (!(first_ > 0)) first_ = bright, first_true_ = true_bright;
    if (first_ > 0 && first_true_ > 0)
        out.brightness = bright / first_, out.true_brightness = true_bright / first_true_;
    brighten_material(r, matte, gain_);
    if (blur_px_ > 0) blur_inside(r, matte, blur_px_), blur_inside(t, matte, blur_px_);
    const Matte shade = shade_of(t, matte);
    Mean inside, soft, shadow;
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            const int m = matte.row(y)[x];
            if (m == 0) continue;
            double error = 0;
            for (int c = 0; c < 3; ++c)
                error += 255.0 / 3 *
                         std::abs(static_cast<double>(linear_to_srgb(r.pixel(x, y)[c])) -
                                  static_cast<double>(linear_to_srgb(t.pixel(x, y)[c])));
            if (!std::isfinite(error)) continue;
            if (m >= kInsideCoverage)
                inside.add(error);
            else if (m > 255 - kInsideCoverage)
                soft.add(error);
            if (shade.row(y)[x]) shadow.add(error);
        }
    }
    out.inside = inside.value(), out.soft_edge = soft.value(), out.shadow = shadow.value();
    return out;
}

}  // namespace weft
