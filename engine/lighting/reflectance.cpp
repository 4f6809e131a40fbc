#include "engine/lighting/reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/linear_system.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/quadratic_fit.h"
#include "engine/lighting/sky_shade.h"

namespace weft {
namespace {

constexpr int kTerms = 5;
constexpr float kMaxDeviations = 3.0f;  // chromaticities beyond are clamped
// Of the terms' variance, so that flat colours explain nothing.
constexpr double kTermRidge = 0.02;
// Chromaticities (ln) that vary less than this are noise or come from the floor, not from paint.
constexpr float kMinDeviation = 0.15f;
// Share of the differences' energy that colour explains: up to kExplainsNothing the relation is
// chance or the bluish tint of shadows and is ignored; from kExplains on it is used in full.
constexpr double kExplainsNothing = 0.2, kExplains = 0.5;
// Share of the explained variance in wide structures: up to kTint it is the light's tint, from
// kPaint on it is painted areas.
constexpr double kTint = 0.1, kPaint = 0.25;
// Of what colour explains: its deviation over its slopes' root mean square. In pixels: edges cannot
// be told from slopes up to kUnresolved, and it counts as paint.
constexpr float kUnresolved = 1.9f, kResolved = 2.15f;
// Of the window: up to kFineColour it is paint, from kWideColour on it may be sheen.
constexpr float kInside = 0.5f;  // of the weight: the rim shows other things
constexpr float kFineColour = 0.12f, kWideColour = 0.16f;
// Its slopes' squared mean over their mean square: up to kAtEdges they lie at the edges of paints,
// from kAllOver on they are all over the surface (noise: 0.79).
constexpr float kAtEdges = 0.5f, kAllOver = 0.56f;
// (skewness² + 1) / kurtosis, Sarle's coefficient: two paints have 1, a normal distribution 1/3.
constexpr float kOneMode = 0.75f, kTwoModes = 0.85f;

struct Standard {
    float mean = 0;
    float inverse_deviation = 0;
};

// Weighted mean and deviation. Rows are summed in order, so that the number of threads does not
// matter.
Standard standard_of(const ImageF1& plane, const ImageF1& weight,
                     float min_deviation = kMinDeviation) {
    struct Sums {
        double w = 0, v = 0, v2 = 0;
    };
    std::vector<Sums> rows(static_cast<std::size_t>(plane.height()));
    parallel_rows(plane.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            Sums s;
            for (int x = 0; x < plane.width(); ++x) {
                const double w = weight.row(y)[x], v = plane.row(y)[x];
                s.w += w, s.v += w * v, s.v2 += w * v * v;
            }
            rows[static_cast<std::size_t>(y)] = s;
        }
    });
    Sums all;
    for (const Sums& s : rows)
        all.w += s.w, all.v += s.v, all.v2 += s.v2;
    if (all.w <= 0) return {};
    const double mean = all.v / all.w;
    const double deviation = std::sqrt(std::max(0.0, all.v2 / all.w - mean * mean));
    return {static_cast<float>(mean),
            1.0f / std::max(min_deviation, static_cast<float>(deviation))};
}

using TermPlanes = std::array<ImageF1, kTerms>;

// u, v, u², uv, v² of the standardised chromaticity.
TermPlanes terms_of(const SurfaceSample& s, const SkyShade& shade) {
    ImageF1 red_green = s.red_green, blue_green = s.blue_green;
    shade.take_out(red_green, blue_green);
    const Standard rg = standard_of(red_green, s.weight);
    const Standard bg = standard_of(blue_green, s.weight);
    TermPlanes terms;
    terms.fill(ImageF1(s.box.size()));
    parallel_rows(s.box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < s.box.width(); ++x) {
                if (s.weight.row(y)[x] == 0) continue;
                const auto at = [&](const ImageF1& plane, const Standard& standard) {
                    return std::clamp(
                        (plane.row(y)[x] - standard.mean) * standard.inverse_deviation,
                        -kMaxDeviations, kMaxDeviations);
                };
                const float u = at(red_green, rg), v = at(blue_green, bg);
                const std::array<float, kTerms> values{u, v, u * u, u * v, v * v};
                for (int k = 0; k < kTerms; ++k)
                    terms[static_cast<std::size_t>(k)].row(y)[x] =
                        values[static_cast<std::size_t>(k)];
            }
        }
    });
    return terms;
}

using Normal = LinearSystem<kTerms>;

Normal normal_equations(const TermPlanes& terms, const ImageF1& target, const ImageF1& weight) {
    std::vector<Normal> rows(static_cast<std::size_t>(target.height()), Normal{});
    parallel_rows(target.height(), 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            Normal& n = rows[static_cast<std::size_t>(y)];
            for (int x = 0; x < target.width(); ++x) {
                const double w = weight.row(y)[x];
                if (w == 0) continue;
                std::array<double, kTerms + 1> v;
                for (std::size_t k = 0; k < kTerms; ++k)
                    v[k] = terms[k].row(y)[x];
                v[kTerms] = target.row(y)[x];
                for (std::size_t i = 0; i < kTerms; ++i) {
                    for (std::size_t j = i; j <= kTerms; ++j)
                        n[i][j] += w * v[i] * v[j];
                }
            }
        }
    });
    Normal all{};
    for (const Normal& n : rows) {
        for (std::size_t i = 0; i < kTerms; ++i) {
            for (std::size_t j = i; j <= kTerms; ++j)
                all[i][j] += n[i][j];
        }
    }
    double total = 0;
    for (int y = 0; y < weight.height(); ++y) {
        for (int x = 0; x < weight.width(); ++x)
            total += weight.row(y)[x];
    }
    // The terms are in standard deviations of the chromaticity, and so is the ridge.
    for (std::size_t i = 0; i < kTerms; ++i) {
        for (std::size_t j = 0; j < i; ++j)
            all[i][j] = all[j][i];
        all[i][i] += kTermRidge * std::max(total, 1.0);
    }
    return all;
}

double weighted_energy(const ImageF1& plane, const ImageF1& weight) {
    double sum = 0;
    for (std::size_t i = 0; i < plane.size_bytes() / sizeof(float); ++i) {
        const double v = plane.data()[i];
        sum += weight.data()[i] * v * v;
    }
    return sum;
}

// The coefficients, scaled down where they explain little.
std::array<double, kTerms> shrunk_coefficients(const TermPlanes& differences, const ImageF1& target,
                                               const ImageF1& weight) {
    const Normal normal = normal_equations(differences, target, weight);
    std::array<double, kTerms> coefficients = solve(normal);
    double explained = 0;
    for (std::size_t k = 0; k < kTerms; ++k)
        explained += coefficients[k] * normal[k][kTerms];
    const double share = explained / std::max(1e-12, weighted_energy(target, weight));
    const double confidence = smooth_step(share, kExplainsNothing, kExplains);
    for (double& c : coefficients)
        c *= confidence;
    return coefficients;
}

// Light reflected from other objects gives a surface a wide, faint tint. The share of the explained
// part that looks like this is left to the light.
void keep_tint_of_light(ImageF1& explained, const ImageF1& weight) {
    const ImageF1 wide = QuadraticFit(explained, weight).surface();
    const auto variance = [&](const ImageF1& plane) {
        const float inverse = standard_of(plane, weight, 1e-6f).inverse_deviation;
        return 1.0 / (static_cast<double>(inverse) * inverse);
    };
    const double share = variance(wide) / std::max(1e-12, variance(explained));
    const auto keep = static_cast<float>(1.0 - smooth_step(share, kTint, kPaint));
    const float mean = standard_of(wide, weight).mean;
    for (std::size_t i = 0; i < wide.size_bytes() / sizeof(float); ++i)
        explained.data()[i] -= keep * (wide.data()[i] - mean);
}

// The powers of a plane's differences from its mean, and of its slopes, summed up.
struct ColourMoments {
    double count = 0, second = 0, third = 0, fourth = 0, slope = 0, square_slope = 0;
};

ColourMoments moments_inside(const ImageF1& plane, const ImageF1& weight, float mean) {
    ColourMoments m;
    const auto inside = [&](int x, int y) { return weight.row(y)[x] > kInside; };
    for (int y = 1; y + 1 < plane.height(); ++y) {
        for (int x = 1; x + 1 < plane.width(); ++x) {
            if (!inside(x, y) || !inside(x - 1, y) || !inside(x + 1, y) || !inside(x, y - 1) ||
                !inside(x, y + 1))
                continue;
            const double d = plane.row(y)[x] - mean;
            const double along = 0.5 * (plane.row(y)[x + 1] - plane.row(y)[x - 1]);
            const double down = 0.5 * (plane.row(y + 1)[x] - plane.row(y - 1)[x]);
            const double square = along * along + down * down;
            m.count += 1, m.second += d * d, m.third += d * d * d, m.fourth += d * d * d * d;
            m.slope += std::sqrt(square), m.square_slope += square;
        }
    }
    return m;
}

// Pile and silk shift their colour with direction, so that it goes with the folds' lightness as
// paint would. But it changes all over the surface, in lengths of folds, and has no two values;
// paints meet at edges.
float sheen_share(const ImageF1& explained, const ImageF1& weight, int window_px) {
    const float mean = standard_of(explained, weight).mean;
    const ColourMoments m = moments_inside(explained, weight, mean);
    if (!(m.second > 0) || !(m.square_slope > 0)) return 0;
    const double n = m.count, variance = m.second / n;
    const double wide = std::sqrt(m.second / m.square_slope);
    const double all_over = m.slope * m.slope / (n * m.square_slope);
    const double skewness = m.third / n / (variance * std::sqrt(variance));
    const double modes = (skewness * skewness + 1) * variance * variance / (m.fourth / n);
    return smooth_step(static_cast<float>(wide), kUnresolved, kResolved) *
           smooth_step(static_cast<float>(wide / window_px), kFineColour, kWideColour) *
           smooth_step(static_cast<float>(all_over), kAtEdges, kAllOver) *
           (1 - smooth_step(static_cast<float>(modes), kOneMode, kTwoModes));
}

}  // namespace

ColourCues colour_cues(const SurfaceSample& sample, int window_px, const Daylight& daylight) {
    ImageF1 weight_mean = sample.weight;
    box_blur(weight_mean, window_px);
    const ImageF1 target = high_pass(sample.luma, sample.weight, weight_mean, window_px);
    const SkyShade shade(sample, weight_mean, target, window_px, daylight);
    const TermPlanes terms = terms_of(sample, shade);
    TermPlanes differences;
    for (std::size_t k = 0; k < kTerms; ++k)
        differences[k] = high_pass(terms[k], sample.weight, weight_mean, window_px);
    const auto coefficients = shrunk_coefficients(differences, target, shade.weight_of_paint());

    ImageF1 explained(sample.box.size());
    parallel_rows(sample.box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            float* e = explained.row(y);
            for (std::size_t k = 0; k < kTerms; ++k) {
                const float c = static_cast<float>(coefficients[k]);
                const float* t = terms[k].row(y);
                for (int x = 0; x < sample.box.width(); ++x)
                    e[x] += c * t[x];
            }
        }
    });
    keep_tint_of_light(explained, sample.weight);
    const float mean = standard_of(explained, sample.weight).mean;
    const float paint = 1 - sheen_share(explained, sample.weight, window_px);
    for (std::size_t i = 0; i < explained.size_bytes() / sizeof(float); ++i) {
        float& e = explained.data()[i];
        e = sample.weight.data()[i] > 0 ? paint * (e - mean) : 0.0f;
    }
    return {std::move(explained), shade.light(), shade.evidence()};
}

}  // namespace weft
