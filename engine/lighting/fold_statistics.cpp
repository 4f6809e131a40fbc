#include "engine/lighting/fold_statistics.h"

#include <algorithm>
#include <cmath>

#include "engine/core/smooth_step.h"
#include "engine/lighting/masked_filters.h"

namespace weft {
namespace {

constexpr float kInside = 0.5f;  // of the weight: the rim shows other things
// The coherence of the structure tensor (Bigün & Granlund 1987) over kWidths widths of what a blur
// leaves, since slopes of noise have no direction: below kNoDirection it is no fold. Measured on
// film: clouds, stains, a goat 0.2 to 0.4; a rug that waves, a bedspread, a wall whose lamps have
// two colours 0.7 to 0.8.
constexpr float kNoDirection = 0.45f, kDirection = 0.6f, kWidths = 2.0f;
// The clearer the direction, the less else has to speak for folds: limits with little of it, below
// kFaintDirection, and with much, from kClearDirection on.
constexpr float kFaintDirection = 0.6f, kClearDirection = 0.8f;
struct Limits {
    // The deviation over the slopes' root mean square, in pixels: edges cannot be told from slopes
    // up to `unresolved`, and it counts as paint.
    float unresolved = 1.9f, resolved = 2.15f;
    // The same as a share of the window: up to `fine` it is paint, from `wide` on it may be folds.
    float fine = 0.12f, wide = 0.16f;
    // The slopes' squared mean over their mean square: up to `at_edges` they lie at the edges of
    // paints, from `all_over` on they are all over the surface (noise: 0.79).
    float at_edges = 0.5f, all_over = 0.56f;
};
constexpr Limits kFaint{}, kClear{1.3f, 1.5f, 0.12f, 0.16f, 0.3f, 0.38f};
// (skewness² + 1) / kurtosis, Sarle's coefficient: two paints have 1, a normal distribution 1/3.
constexpr float kOneMode = 0.75f, kTwoModes = 0.85f;

// The powers of a plane's differences from its mean, and of its slopes, summed up.
struct FoldMoments {
    double count = 0, second = 0, third = 0, fourth = 0, slope = 0, square_slope = 0;
};

// Pixels whose neighbours are inside, too.
template <class Visit>
void for_each_inside(const ImageF1& weight, const Visit& visit) {
    const auto inside = [&](int x, int y) { return weight.row(y)[x] > kInside; };
    for (int y = 1; y + 1 < weight.height(); ++y) {
        for (int x = 1; x + 1 < weight.width(); ++x) {
            if (inside(x, y) && inside(x - 1, y) && inside(x + 1, y) && inside(x, y - 1) &&
                inside(x, y + 1))
                visit(x, y);
        }
    }
}

struct Slope {
    double along = 0, down = 0;
};

Slope slope_at(const ImageF1& plane, int x, int y) {
    return {0.5 * (plane.row(y)[x + 1] - plane.row(y)[x - 1]),
            0.5 * (plane.row(y + 1)[x] - plane.row(y - 1)[x])};
}

double mean_inside(const ImageF1& plane, const ImageF1& weight) {
    double sum = 0, count = 0;
    for_each_inside(weight, [&](int x, int y) { sum += plane.row(y)[x], count += 1; });
    return count > 0 ? sum / count : 0;
}

FoldMoments moments_inside(const ImageF1& plane, const ImageF1& weight) {
    const double mean = mean_inside(plane, weight);
    FoldMoments m;
    for_each_inside(weight, [&](int x, int y) {
        const double d = plane.row(y)[x] - mean;
        const Slope s = slope_at(plane, x, y);
        const double square = s.along * s.along + s.down * s.down;
        m.count += 1, m.second += d * d, m.third += d * d * d, m.fourth += d * d * d * d;
        m.slope += std::sqrt(square), m.square_slope += square;
    });
    return m;
}

// The deviation over the slopes' root mean square, pixels.
float width_of(const FoldMoments& m) {
    return static_cast<float>(std::sqrt(m.second / std::max(m.square_slope, 1e-12)));
}

// How far the slopes have one direction, 0 to 1, where there are slopes.
float coherence(const ImageF1& plane, const ImageF1& weight, float smooth_px) {
    ImageF1 smooth = weighted(plane, weight), total = weight;
    gaussian_blur(smooth, smooth_px);
    gaussian_blur(total, smooth_px);
    for (std::size_t i = 0; i < smooth.size_bytes() / sizeof(float); ++i)
        smooth.data()[i] /= std::max(total.data()[i], kLeastWeight);
    const float sigma_px = kWidths * width_of(moments_inside(smooth, weight));
    ImageF1 xx(plane.size()), xy(plane.size()), yy(plane.size());
    for_each_inside(weight, [&](int x, int y) {
        const Slope s = slope_at(smooth, x, y);
        xx.row(y)[x] = static_cast<float>(s.along * s.along);
        xy.row(y)[x] = static_cast<float>(s.along * s.down);
        yy.row(y)[x] = static_cast<float>(s.down * s.down);
    });
    for (ImageF1* part : {&xx, &xy, &yy})
        gaussian_blur(*part, sigma_px);
    double directed = 0, all = 0;
    for_each_inside(weight, [&](int x, int y) {
        const double a = xx.row(y)[x], b = xy.row(y)[x], c = yy.row(y)[x];
        directed += std::sqrt((a - c) * (a - c) + 4 * b * b);
        all += a + c;
    });
    return all > 0 ? static_cast<float>(directed / all) : 0.0f;
}

Limits mixed(float clear) {
    const auto mix = [clear](float faint_one, float clear_one) {
        return faint_one + clear * (clear_one - faint_one);
    };
    return {mix(kFaint.unresolved, kClear.unresolved),
            mix(kFaint.resolved, kClear.resolved),
            mix(kFaint.fine, kClear.fine),
            mix(kFaint.wide, kClear.wide),
            mix(kFaint.at_edges, kClear.at_edges),
            mix(kFaint.all_over, kClear.all_over)};
}

float share_within(const Limits& limits, float wide, float all_over, int window_px) {
    return smooth_step(wide, limits.unresolved, limits.resolved) *
           smooth_step(wide / static_cast<float>(window_px), limits.fine, limits.wide) *
           smooth_step(all_over, limits.at_edges, limits.all_over);
}

}  // namespace

float fold_share(const ImageF1& plane, const ImageF1& weight, int window_px, float smooth_px) {
    const FoldMoments m = moments_inside(plane, weight);
    if (!(m.second > 0) || !(m.square_slope > 0)) return 0;
    const double n = m.count, variance = m.second / n;
    const float wide = width_of(m);
    const double all_over = m.slope * m.slope / (n * m.square_slope);
    const double skewness = m.third / n / (variance * std::sqrt(variance));
    const double modes = (skewness * skewness + 1) * variance * variance / (m.fourth / n);
    const float modal = 1 - smooth_step(static_cast<float>(modes), kOneMode, kTwoModes);
    // What fails with much direction need not have it measured.
    if (!(modal * share_within(kClear, wide, static_cast<float>(all_over), window_px) > 0))
        return 0;
    const float directed = coherence(plane, weight, smooth_px);
    const Limits limits = mixed(smooth_step(directed, kFaintDirection, kClearDirection));
    return modal * smooth_step(directed, kNoDirection, kDirection) *
           share_within(limits, wide, static_cast<float>(all_over), window_px);
}

}  // namespace weft
