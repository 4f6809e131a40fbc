#include "engine/lighting/clip_reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/core/median.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/light_doubt.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/pattern_period.h"

namespace weft {
namespace {

constexpr int kFewestFrames = 3;
constexpr float kSplatKnown = 0.2f;  // of a pixel's weight
constexpr int kLongestPeriod = 64;   // small pixels
constexpr float kPeriods = 1.0f;     // features up to this many periods wide are paint
// Of the pattern's deviation: what a blur may leave of it, and what is light for certain.
constexpr double kRemainsOfPattern = 2.0, kMoreThanPattern = 3.0;
constexpr int kLevelRounds = 3, kLevelStep = 3;  // rounds, and pixels between samples
// ln light below the brightest frame's: what a fade leaves of the pattern is mostly noise.
constexpr float kFaded = 3.0f;

// Quantiles, as a share of the values below.
using Share = std::array<std::ptrdiff_t, 2>;
constexpr Share kMiddle{1, 2}, kUpperQuarter{3, 4};
// A place that is lit in a fifth of the frames gets its lit value; the rest may be in moving
// shadow.
constexpr Share kLit{4, 5};

float quantile_at(std::vector<float>& values, Share share) {
    const auto n = static_cast<std::ptrdiff_t>(values.size());
    const auto at = values.begin() + std::min(n - 1, n * share[0] / share[1]);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

// Bounding box of the places where a sample's pixels lie on the reference frame.
Recti mapped_box(const SurfaceSample& s, const ImageF2& ref_from_cur) {
    float x0 = 1e9f, y0 = 1e9f, x1 = -1e9f, y1 = -1e9f;
    for (int y = 0; y < s.box.height(); ++y) {
        for (int x = 0; x < s.box.width(); ++x) {
            if (s.weight.row(y)[x] == 0) continue;
            const float* d = ref_from_cur.pixel(x, y);
            const float u = static_cast<float>(x + s.box.x0) + d[0];
            const float v = static_cast<float>(y + s.box.y0) + d[1];
            if (!std::isfinite(u + v)) continue;
            x0 = std::min(x0, u), x1 = std::max(x1, u);
            y0 = std::min(y0, v), y1 = std::max(y1, v);
        }
    }
    // Pixels more than a frame's size away are ignored: they are unlikely to return to the picture.
    const Size small = reduced_size(s.full, s.downscale);
    const Recti limit{-small.width, -small.height, 2 * small.width, 2 * small.height};
    if (x0 > x1) return {};
    const auto whole = [](float v, float low, float high) {
        return static_cast<int>(std::floor(std::clamp(v, low, high)));
    };
    const float far = 4.0f * static_cast<float>(std::max(small.width, small.height));
    return Recti{whole(x0, -far, far), whole(y0, -far, far), whole(x1, -far, far) + 2,
                 whole(y1, -far, far) + 2}
        .intersected(limit);
}

ImageF1 difference_of(const ImageF1& a, const ImageF1& b, const ImageF1& known) {
    ImageF1 out(a.size());
    for (std::size_t i = 0; i < out.size_bytes() / sizeof(float); ++i) {
        if (known.data()[i] > 0) out.data()[i] = a.data()[i] - b.data()[i];
    }
    return out;
}

double energy(const ImageF1& plane) {
    double sum = 0;
    for (std::size_t i = 0; i < plane.size_bytes() / sizeof(float); ++i)
        sum += static_cast<double>(plane.data()[i]) * plane.data()[i];
    return sum;
}

// How far `rest` may be remains of the pattern, 0 to 1. Shadows are stronger than a faint pattern:
// what would leave more behind than there is of it was never a part of it.
float remains_share(const ImageF1& rest, const ImageF1& pattern) {
    const double ratio = std::sqrt(energy(rest) / std::max(energy(pattern), 1e-9));
    return static_cast<float>(1.0 - smooth_step(ratio, kRemainsOfPattern, kMoreThanPattern));
}

}  // namespace

void ReflectanceGatherer::add(const SurfaceSample& s, const ImageF2& ref_from_cur) {
    if (s.box.empty()) return;
    Part part;
    part.box = mapped_box(s, ref_from_cur);
    if (part.box.empty()) return;
    downscale_ = s.downscale;
    part.printed = s.print.confidence;
    part.marks = surface_pattern(painted_luma(s), undecided_luma(s), s.weight, pattern_px()).marks;
    part.luma = part.paint = part.weight = ImageF1(part.box.size());
    // A splat is a scatter: one thread, so that sums come in one order.
    for (int y = 0; y < s.box.height(); ++y) {
        for (int x = 0; x < s.box.width(); ++x) {
            const float w = s.weight.row(y)[x];
            if (w == 0) continue;
            const float* d = ref_from_cur.pixel(x, y);
            const float u =
                static_cast<float>(x + s.box.x0) + d[0] - static_cast<float>(part.box.x0);
            const float v =
                static_cast<float>(y + s.box.y0) + d[1] - static_cast<float>(part.box.y0);
            if (!(u >= 0 && v >= 0 && u < static_cast<float>(part.box.width() - 1) &&
                  v < static_cast<float>(part.box.height() - 1)))
                continue;
            const int i = static_cast<int>(u), j = static_cast<int>(v);
            const float fx = u - static_cast<float>(i), fy = v - static_cast<float>(j);
            const float luma =
                s.luma.row(y)[x] - (s.daylight.empty() ? 0.0f : s.daylight.row(y)[x]);
            const float paint = s.paint.empty() ? 0.0f : s.paint.row(y)[x];
            const auto put = [&](int a, int b, float share) {
                share *= w;
                part.weight.row(b)[a] += share;
                part.luma.row(b)[a] += share * luma;
                part.paint.row(b)[a] += share * paint;
            };
            put(i, j, (1 - fx) * (1 - fy)), put(i + 1, j, fx * (1 - fy));
            put(i, j + 1, (1 - fx) * fy), put(i + 1, j + 1, fx * fy);
        }
    }
    for (std::size_t i = 0; i < part.weight.size_bytes() / sizeof(float); ++i) {
        float& w = part.weight.data()[i];
        if (w > kSplatKnown) {
            part.luma.data()[i] /= w;
            part.paint.data()[i] /= w;
        } else {
            w = 0;
        }
    }
    parts_.push_back(std::move(part));
}

// The quantile of `value` over the frames that show each place. 0, and unknown, where fewer than
// kFewestFrames do.
template <typename Value>
ImageF1 ReflectanceGatherer::over_time(const Recti& box, std::array<std::ptrdiff_t, 2> share,
                                       ImageF1& known, const Value& value, int step) const {
    ImageF1 out(box.size());
    known = ImageF1(box.size());
    parallel_rows(box.height(), 8, [&](int y0, int y1) {
        std::vector<float> values;
        for (int y = (y0 + step - 1) / step * step; y < y1; y += step) {
            for (int x = 0; x < box.width(); x += step) {
                values.clear();
                for (const Part& part : parts_) {
                    const int u = x + box.x0 - part.box.x0, v = y + box.y0 - part.box.y0;
                    if (u < 0 || v < 0 || u >= part.box.width() || v >= part.box.height()) continue;
                    if (part.weight.row(v)[u] > 0) values.push_back(value(part, u, v));
                }
                if (static_cast<int>(values.size()) < kFewestFrames) continue;
                known.row(y)[x] = 1;
                out.row(y)[x] = quantile_at(values, share);
            }
        }
    });
    return out;
}

// The light level of each whole frame, measured at places that other frames also show. Uses the
// upper quarter, because shadows may cover most of a frame.
void ReflectanceGatherer::find_levels(const Recti& box) {
    ImageF1 known;
    std::vector<float> differences;
    for (int round = 0; round < kLevelRounds; ++round) {
        const ImageF1 usual = over_time(
            box, kMiddle, known,
            [](const Part& part, int u, int v) { return part.luma.row(v)[u] - part.level; },
            kLevelStep);
        for (Part& part : parts_) {
            differences.clear();
            for (int v = 0; v < part.box.height(); ++v) {
                for (int u = 0; u < part.box.width(); ++u) {
                    const int x = u + part.box.x0 - box.x0, y = v + part.box.y0 - box.y0;
                    if (part.weight.row(v)[u] > 0 && known.row(y)[x] > 0)
                        differences.push_back(part.luma.row(v)[u] - usual.row(y)[x]);
                }
            }
            if (!differences.empty()) part.level = quantile_at(differences, kUpperQuarter);
        }
    }
}

// In a single frame they are sharp; here, motion that is off by a pixel blurs them.
PrintedMarks ReflectanceGatherer::usual_marks() const {
    const auto often = [&](bool PrintedMarks::*kind) {
        return 2 * std::count_if(parts_.begin(), parts_.end(),
                                 [&](const Part& part) { return part.marks.*kind; }) >=
               static_cast<std::ptrdiff_t>(parts_.size());
    };
    return {often(&PrintedMarks::dark), often(&PrintedMarks::light)};
}

float ReflectanceGatherer::pattern_px() const {
    return std::max(1.0f, options_.pattern_px / static_cast<float>(downscale_));
}

ClipReflectance ReflectanceGatherer::finish() {
    ClipReflectance out;
    if (static_cast<int>(parts_.size()) < kFewestFrames) return out;
    for (const Part& part : parts_)
        out.box = out.box.united(part.box);
    out.marks = usual_marks();
    find_levels(out.box);
    const auto darker = [](const Part& a, const Part& b) { return a.level < b.level; };
    const float full = std::max_element(parts_.begin(), parts_.end(), darker)->level;
    std::erase_if(parts_, [&](const Part& part) { return part.level < full - kFaded; });
    // The surface without moving shadows. The light that remains does not move with time; it is
    // separated from the pattern as in a single frame.
    SurfaceSample still;
    still.box = out.box;
    still.downscale = downscale_;
    still.full = Size{out.box.width() * downscale_, out.box.height() * downscale_};
    still.luma = over_time(out.box, kLit, out.confidence, [](const Part& part, int u, int v) {
        return part.luma.row(v)[u] - part.level;
    });
    still.paint = over_time(out.box, kMiddle, still.weight,
                            [](const Part& part, int u, int v) { return part.paint.row(v)[u]; });
    if (!std::any_of(still.weight.data(),
                     still.weight.data() + still.weight.size_bytes() / sizeof(float),
                     [](float w) { return w > 0; })) {
        return {};
    }
    for (const Part& part : parts_)
        still.print.confidence = std::max(still.print.confidence, part.printed);
    auto [light, pattern] = log_shading(still, options_);
    out.value = difference_of(still.luma, light, out.confidence);
    out.presence = pattern.presence;
    const int period = pattern_period_px(out.value, out.confidence, kLongestPeriod);
    if (period > 0 && pattern.presence > 0) {
        // Here larger features of the pattern can be separated from light than in a single frame:
        // up to the pattern's period.
        const ImageF1 wide = light_beyond_period(light, out.confidence, out.value,
                                                 static_cast<float>(period) * kPeriods);
        const float share =
            pattern.presence * remains_share(difference_of(light, wide, out.confidence), out.value);
        for (std::size_t i = 0; i < light.size_bytes() / sizeof(float); ++i)
            light.data()[i] += share * (wide.data()[i] - light.data()[i]);
        out.value = difference_of(still.luma, light, out.confidence);
    }
    // What moves has been told from paint by that; the light that never does has not.
    out.doubt = light_doubt(light, difference_of(out.value, still.paint, out.confidence),
                            weighted(out.confidence, pattern.ground), pattern_px());
    // Between marks a plain ground has nothing but its colour: what else is known there are lines
    // that motion moved beside their places, which would shine through where the frame has none.
    if (out.marks.dark || out.marks.light) {
        const ImageF1 own = difference_of(out.value, still.paint, out.confidence);
        for (std::size_t i = 0; i < own.size_bytes() / sizeof(float); ++i)
            out.value.data()[i] -= (1 - out.presence) * own.data()[i];
    }
    return out;
}

}  // namespace weft
