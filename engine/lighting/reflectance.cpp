#include "engine/lighting/reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/linear_system.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/fold_statistics.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/quadratic_fit.h"
#include "engine/lighting/sky_shade.h"
#include "engine/lighting/surface_pattern.h"

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
// Chromaticities are noisy: the blur before the direction of folds is measured, of the window, and
// in pixels.
constexpr float kSmooth = 0.25f, kLeastSmooth = 2.0f;

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

// Pile and silk shift their colour with direction, so that it goes with the folds' lightness as
// paint's would. What is printed on one ground has a direction, too, and is left out.
float sheen_share(const SurfaceSample& sample, const SkyShade& shade, const ImageF1& explained,
                  int window_px) {
    ImageF1 luma = sample.luma;
    for (std::size_t i = 0; i < shade.light().size_bytes() / sizeof(float); ++i)
        luma.data()[i] -= shade.light().data()[i];
    const float pattern_px = static_cast<float>(window_px) / kChromaWindow;
    const ImageF1 ground = surface_pattern(luma, luma, sample.weight, pattern_px).ground;
    return fold_share(explained, ground, window_px,
                      std::max(kLeastSmooth, kSmooth * static_cast<float>(window_px)));
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
    const float paint = 1 - sheen_share(sample, shade, explained, window_px);
    for (std::size_t i = 0; i < explained.size_bytes() / sizeof(float); ++i) {
        float& e = explained.data()[i];
        e = sample.weight.data()[i] > 0 ? paint * (e - mean) : 0.0f;
    }
    return {std::move(explained), shade.light(), shade.evidence()};
}

}  // namespace weft
