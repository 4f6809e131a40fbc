#include "engine/mask/edge_shift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/box_gaussian.h"
#include "engine/mask/copy_of.h"
#include "engine/mask/level_distance.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

// Level sets that soft edges are moved by; between them values are interpolated.
constexpr std::array kLevels{0.004f, 0.06f, 0.18f, 0.34f, 0.5f, 0.66f, 0.82f, 0.94f, 0.996f};
constexpr float kMisfit = 0.15f;  // of coverage, from which an edge is not a line
// Widths between which a line is blended into a soft edge, and gaps between level sets between
// which interpolation is blended into the value at the place that a pixel takes over, px.
constexpr float kLine_px = 2.5f, kSoft_px = 3.5f, kRamp_px = 4, kPlateau_px = 8;
constexpr float kMargin_px = 9;  // that distances have to tell beyond the farthest shift

// How far distances have to tell for a Gaussian of this deviation.
float smooth_reach(float sigma_px) {
    return 3 * sigma_px;
}

float coverage_of(float distance) {
    return std::clamp(0.5f + distance, 0.0f, 1.0f);
}

float share_between(float v, float low, float high) {
    return std::clamp((v - low) / (high - low), 0.0f, 1.0f);
}

// What a line at this distance covers after the shift: level t lies at the distance t − ½, and
// moves by all + low + t (high − low).
float shifted_coverage(float distance, const EdgeShift& shift) {
    const float width = 1 - (shift.high - shift.low);
    return std::clamp((distance + 0.5f + shift.all + shift.low) / width, 0.0f, 1.0f);
}

// Where the matte is no line, from its distance φ at one half; empty: nowhere.
Recti soft_box(const ImageF1& alpha, const ImageF1& phi) {
    std::vector<Recti> rows(static_cast<std::size_t>(alpha.height()));
    parallel_rows(alpha.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            Recti& row = rows[static_cast<std::size_t>(y)];
            for (int x = 0; x < alpha.width(); ++x) {
                const float off = alpha.row(y)[x] - coverage_of(phi.row(y)[x]);
                if (std::abs(off) <= kMisfit) continue;
                if (row.empty()) row = {x, y, x + 1, y + 1};
                row.x1 = x + 1;
            }
        }
    });
    Recti box;
    for (const Recti& row : rows)
        box = box.united(row);
    return box;
}

// Towards larger values, of unit length; zero where the field is flat.
Vec2 direction(ViewF1 field, int x, int y) {
    const int w = field.width() - 1, h = field.height() - 1;
    const Vec2 d(field.row(y)[std::min(x + 1, w)] - field.row(y)[std::max(x - 1, 0)],
                 field.row(std::min(y + 1, h))[x] - field.row(std::max(y - 1, 0))[x]);
    const float length = std::sqrt(d.x * d.x + d.y * d.y);
    return length > 1e-6f ? d / length : Vec2(0);
}

// 2 G φ − G G φ.
ImageF1 twiced(ImageF1 phi, float sigma_px) {
    ImageF1 once = box_gaussian(std::move(phi), sigma_px);
    const ImageF1 twice = box_gaussian(once, sigma_px);
    parallel_rows(once.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < once.width(); ++x)
                once.row(y)[x] = 2 * once.row(y)[x] - twice.row(y)[x];
    });
    return once;
}

// How soft edges are moved, level set by level set from the lowest: by `shift`, and smoothed.
class SoftShift {
  public:
    SoftShift(const ImageF1& alpha, const EdgeShift& shift, float sigma_px)
        : alpha_(alpha), shift_(shift), value_(alpha.size(), kPending), width_(alpha.size(), 0.0f) {
        const float reach = shift.reach() + smooth_reach(sigma_px) + kMargin_px;
        for (std::size_t k = 0; k < kLevels.size(); ++k) {
            ImageF1 phi = level_distance(alpha, kLevels[k], reach);
            if (sigma_px > 0) phi = twiced(std::move(phi), sigma_px);
            if (k == 0) lowest_ = phi;
            take(k, phi);
            last_ = std::move(phi);
        }
    }

    // The value after the shift, and how far the edge is from being a line, 0–1.
    [[nodiscard]] float value(int x, int y) const {
        const float v = value_.row(y)[x];
        return v == kPending ? 1 : v;
    }
    [[nodiscard]] float softness(int x, int y) const {
        return share_between(width_.row(y)[x], kLine_px, kSoft_px);
    }

  private:
    static constexpr float kPending = -1;

    void take(std::size_t k, const ImageF1& phi) {
        const bool top = k + 1 == kLevels.size();
        parallel_rows(phi.height(), 16, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y) {
                for (int x = 0; x < phi.width(); ++x) {
                    if (top) width_.row(y)[x] = lowest_.row(y)[x] - phi.row(y)[x];
                    float& value = value_.row(y)[x];
                    const float high = phi.row(y)[x] + shift_.of(kLevels[k]);
                    if (value != kPending || high >= 0) continue;
                    value = k == 0 ? 0 : between(k, high, x, y);
                }
            }
        });
    }

    // The pixel comes to lie between the levels k − 1 and k, at the distance `high` from the upper
    // one. Across a ramp the distances tell where. On a plateau its own value counts: that of the
    // place which is moved to the pixel.
    [[nodiscard]] float between(std::size_t k, float high, int x, int y) const {
        const float from = kLevels[k - 1], to = kLevels[k];
        const float low = last_.row(y)[x] + shift_.of(from);
        const float t = from + (to - from) * low / (low - high);
        const float plateau = share_between(low - high, kRamp_px, kPlateau_px);
        if (plateau <= 0) return t;
        const Vec2 at = Vec2(static_cast<float>(x), static_cast<float>(y)) +
                        shift_.of(t) * direction(last_, x, y);
        const float there = std::clamp(sample_bilinear(alpha_, at.x, at.y), from, to);
        return t + plateau * (there - t);
    }

    const ImageF1& alpha_;
    EdgeShift shift_;
    ImageF1 value_, width_, lowest_, last_;
};

ImageF1 moved_edge(const ImageF1& alpha, const EdgeShift& shift, float sigma_px) {
    const float reach = shift.reach() + smooth_reach(sigma_px) + kMargin_px;
    ImageF1 phi = level_distance(alpha, 0.5f, reach);
    const Recti soft = soft_box(alpha, phi);
    if (sigma_px > 0) phi = twiced(std::move(phi), sigma_px);
    ImageF1 out(alpha.size());
    parallel_rows(alpha.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < alpha.width(); ++x)
                out.row(y)[x] = shifted_coverage(phi.row(y)[x], shift);
    });
    if (soft.empty()) return out;
    const int around = static_cast<int>(std::ceil(reach)) + 3;
    const Recti box = soft.grown(around).intersected(rect_of(alpha.size()));
    const ImageF1 part = copy_of(alpha.view().crop(box));
    const SoftShift moved(part, shift, sigma_px);
    parallel_rows(box.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < box.width(); ++x) {
                float& v = out.row(box.y0 + y)[box.x0 + x];
                v += moved.softness(x, y) * (moved.value(x, y) - v);
            }
        }
    });
    return out;
}

}  // namespace

ImageF1 shifted_edge(const ImageF1& alpha, const EdgeShift& shift) {
    return moved_edge(alpha, shift, 0);
}

ImageF1 smoothed_edge(const ImageF1& alpha, float sigma_px) {
    return moved_edge(alpha, {}, sigma_px);
}

}  // namespace weft
