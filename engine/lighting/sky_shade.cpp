#include "engine/lighting/sky_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/linear_system.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/bilateral_grid.h"
#include "engine/lighting/masked_filters.h"

namespace weft {
namespace {

// From sky to sun, in ln R/G and ln B/G of linear sRGB (unit vector): daylight of 2,500 K to
// 6,500 K over a sky of 7,000 K to 20,000 K.
constexpr float kRed = 0.559f, kBlue = -0.829f;

// How much ln R/G falls and ln B/G rises per unit of ln luma when the sun's light is missing. Paint
// seldom does both; white beside indigo rises by more.
constexpr float kFaintestSky = 0.03f, kSky = 0.08f, kBluestSky = 0.35f, kBluerThanSky = 0.5f;
constexpr float kFaintShade = 0.08f, kShade = 0.2f;  // ln luma: not reliable below
// The same along the locus.
constexpr double kFaintestAlong = 0.05, kAlong = 0.11, kBluestAlong = 0.4, kBluerAlong = 0.55;
// The share of the wide differences of luma that go with such colours; both are regressed on the
// colours across the locus first.
constexpr double kChance = 0.5, kShadeAlone = 0.75;
// Of the wide differences of luma, what the colours across the locus leave: less is paint's rest.
constexpr double kLittleLeft = 0.1, kMuchLeft = 0.25;
constexpr int kDetail = 4;  // of the window: paint may be finer
constexpr float kLeastWeight = 1e-3f;
// Deviation of a chromaticity across the locus (ln) that is too little to tell paints apart.
constexpr double kOnePaint = 0.08;
constexpr double kLeastLight = 1e-4;  // of that ridge: keeps the equations solvable
// What averages the noise of the colours: small pixels, and ln luma.
constexpr float kShadeSpace = 5.0f, kShadeRange = 0.15f, kGuideSigma = 0.8f;

std::size_t count_of(const ImageF1& plane) {
    return plane.size_bytes() / sizeof(float);
}

// How much a difference looks like missing sunlight, 0 to 1.
float looks_like_shade(float luma, float red_green, float blue_green) {
    const float seen = smooth_step(std::abs(luma), kFaintShade, kShade);
    if (seen == 0) return 0;
    const auto bluish = [](float slope) {
        return smooth_step(slope, kFaintestSky, kSky) *
               (1.0f - smooth_step(slope, kBluestSky, kBluerThanSky));
    };
    const float red = bluish(red_green / luma);
    return red == 0 ? 0.0f : seen * red * bluish(-blue_green / luma);
}

template <std::size_t N>
using Moments = std::array<std::array<double, N>, N>;

// Σ weight · plane i · plane j. Rows are summed in order, so that the number of threads does not
// matter.
template <std::size_t N>
Moments<N> moments_of(const std::array<const ImageF1*, N>& planes, const ImageF1& weight) {
    std::vector<Moments<N>> rows(static_cast<std::size_t>(weight.height()), Moments<N>{});
    parallel_rows(weight.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            Moments<N>& row = rows[static_cast<std::size_t>(y)];
            for (int x = 0; x < weight.width(); ++x) {
                const double w = weight.row(y)[x];
                for (std::size_t i = 0; i < N; ++i) {
                    const double wi = w * planes[i]->row(y)[x];
                    for (std::size_t j = i; j < N; ++j)
                        row[i][j] += wi * planes[j]->row(y)[x];
                }
            }
        }
    });
    Moments<N> all{};
    for (const Moments<N>& row : rows) {
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t j = i; j < N; ++j)
                all[i][j] += row[i][j];
        }
    }
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = 0; j < i; ++j)
            all[i][j] = all[j][i];
    }
    return all;
}

// Coefficients of the first planes for plane `target`.
template <std::size_t K, std::size_t N>
std::array<double, K> regressed(const Moments<N>& m, std::size_t target,
                                const std::array<double, K>& ridge) {
    LinearSystem<K> system{};
    for (std::size_t i = 0; i < K; ++i) {
        for (std::size_t j = 0; j < K; ++j)
            system[i][j] = m[i][j];
        system[i][i] += ridge[i];
        system[i][K] = m[i][target];
    }
    return solve(system);
}

double total_of(const ImageF1& plane) {
    double sum = 0;
    for (std::size_t i = 0; i < count_of(plane); ++i)
        sum += plane.data()[i];
    return sum;
}

// Damps what few and faint colours would explain by chance.
double ridge_of(const SurfaceSample& s) {
    return kOnePaint * kOnePaint * std::max(total_of(s.weight), 1.0);
}

void subtract_mean(ImageF1& plane, const ImageF1& weight) {
    double sum = 0;
    for (std::size_t i = 0; i < count_of(plane); ++i)
        sum += static_cast<double>(weight.data()[i]) * plane.data()[i];
    const auto mean = static_cast<float>(sum / std::max(total_of(weight), 1e-6));
    for (std::size_t i = 0; i < count_of(plane); ++i)
        plane.data()[i] = weight.data()[i] > 0 ? plane.data()[i] - mean : 0.0f;
}

ImageF1 squared(const ImageF1& plane) {
    return weighted(plane, plane);
}

// Turned by the locus: along it and across it, means 0.
ImageF1 turned(const SurfaceSample& s, float of_red, float of_blue) {
    ImageF1 out(s.box.size());
    for (std::size_t i = 0; i < count_of(out); ++i)
        out.data()[i] = of_red * s.red_green.data()[i] + of_blue * s.blue_green.data()[i];
    subtract_mean(out, s.weight);
    return out;
}

// Differences within a window.
class Window {
  public:
    Window(const SurfaceSample& s, const ImageF1& weight_mean, int radius_px)
        : weight_(s.weight), mean_(weight_mean), radius_(radius_px), near_(s.weight) {
        box_blur(near_, around());
    }
    [[nodiscard]] ImageF1 fine(const ImageF1& plane) const {
        return high_pass(plane, weight_, mean_, radius_);
    }
    // What is wide of fine differences: fine structure is more likely paint than light.
    [[nodiscard]] ImageF1 wide(const ImageF1& detail) const {
        ImageF1 d = weighted(detail, weight_);
        box_blur(d, around());
        for (std::size_t i = 0; i < count_of(d); ++i)
            d.data()[i] /= std::max(near_.data()[i], kLeastWeight);
        return d;
    }

  private:
    [[nodiscard]] int around() const { return std::max(1, radius_ / kDetail); }

    const ImageF1& weight_;
    const ImageF1& mean_;
    int radius_;
    ImageF1 near_;
};

// A surface's colours, turned by the locus.
struct Turned {
    ImageF1 along, across, across_squared;
};

// Paint's part of another plane for its colour across the locus, and that squared.
using PaintPart = std::array<double, 2>;

void subtract(ImageF1& plane, const PaintPart& part, const Turned& colours) {
    for (std::size_t i = 0; i < count_of(plane); ++i)
        plane.data()[i] -= static_cast<float>(part[0] * colours.across.data()[i] +
                                              part[1] * colours.across_squared.data()[i]);
}

// Without noise, along the edges of the luma.
ImageF1 along_edges(const ImageF1& plane, const SurfaceSample& s) {
    ImageF1 guide = weighted(s.luma, s.weight), weight = s.weight;
    gaussian_blur(guide, kGuideSigma);
    gaussian_blur(weight, kGuideSigma);
    for (std::size_t i = 0; i < count_of(guide); ++i)
        guide.data()[i] /= std::max(weight.data()[i], kLeastWeight);
    return joint_bilateral(weighted(plane, s.weight), s.weight, guide, {kShadeSpace, kShadeRange});
}

// The sample's weight, less where a wide difference looks like shade.
ImageF1 paint_weight(const SurfaceSample& s, const ImageF1& luma, const Turned& wide) {
    ImageF1 weight(s.box.size());
    parallel_rows(s.box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < s.box.width(); ++x) {
                const float a = wide.along.row(y)[x], c = wide.across.row(y)[x];
                const float shade =
                    looks_like_shade(luma.row(y)[x], kRed * a - kBlue * c, kBlue * a + kRed * c);
                weight.row(y)[x] = s.weight.row(y)[x] * (1.0f - shade);
            }
        }
    });
    return weight;
}

// From all differences: fine patterns tell paints apart best.
PaintPart paint_part(const ImageF1& detail, const Turned& details, const SurfaceSample& s) {
    const auto m = moments_of<3>({&details.across, &details.across_squared, &detail}, s.weight);
    const double ridge = ridge_of(s);
    return regressed<2>(m, 2, {ridge, ridge});
}

// Whether lightness goes with the colour along the locus, as it does between sun and sky, when what
// goes with the colour across it is left out of both; 0 to 1.
float presence_of_shade(const SurfaceSample& s, const ImageF1& wide_luma, const Turned& wide,
                        const PaintPart& paint) {
    enum : std::size_t { kAcross, kAcross2, kAlongIt, kLuma, kPlanes };
    const auto m = moments_of<kPlanes>(
        {&wide.across, &wide.across_squared, &wide.along, &wide_luma}, s.weight);
    const double ridge = ridge_of(s);
    const PaintPart of_luma = regressed<2>(m, kLuma, {ridge, ridge});
    const auto left = [&](std::size_t i, const PaintPart& a, std::size_t j, const PaintPart& b) {
        double product = m[i][j];
        for (std::size_t k = 0; k < 2; ++k) {
            product -= a[k] * m[k][j] + b[k] * m[k][i];
            for (std::size_t l = 0; l < 2; ++l)
                product += a[k] * m[k][l] * b[l];
        }
        return product;
    };
    const double luma2 = left(kLuma, of_luma, kLuma, of_luma);
    const double along2 = left(kAlongIt, paint, kAlongIt, paint);
    const double both = left(kAlongIt, paint, kLuma, of_luma);
    if (!(luma2 > 0 && along2 > 0)) return 0;
    const double slope = both / luma2, share = both * both / (luma2 * along2);
    return static_cast<float>(smooth_step(luma2 / m[kLuma][kLuma], kLittleLeft, kMuchLeft) *
                              smooth_step(share, kChance, kShadeAlone) *
                              smooth_step(slope, kFaintestAlong, kAlong) *
                              (1.0 - smooth_step(slope, kBluestAlong, kBluerAlong)));
}

// ln light for the colour along the locus (`colours` without noise): a quadratic, because the sky's
// colour gives way to the sun's with the first of its light.
ImageF1 light_of(const SurfaceSample& s, const Window& window, const Turned& colours,
                 const ImageF1& wide_luma) {
    const ImageF1& sunlit = colours.along;
    const ImageF1 linear = window.wide(window.fine(sunlit)),
                  square = window.wide(window.fine(squared(sunlit))),
                  across = window.wide(window.fine(colours.across)),
                  across_squared = window.wide(window.fine(colours.across_squared));
    const auto m =
        moments_of<5>({&linear, &square, &across, &across_squared, &wide_luma}, s.weight);
    const double paint = ridge_of(s), light = kLeastLight * paint;
    const auto c = regressed<4>(m, 4, {light, light, paint, paint});
    const auto slope = static_cast<float>(c[0]), bend = static_cast<float>(c[1]);
    ImageF1 out(s.box.size());
    for (std::size_t i = 0; i < count_of(out); ++i) {
        float t = sunlit.data()[i];
        // More of the sun's colour is never less light: beyond the vertex the curve stays level.
        if (bend != 0) {
            const float vertex = -slope / (2 * bend);
            t = bend < 0 ? std::min(t, vertex) : std::max(t, vertex);
        }
        out.data()[i] = t * (slope + bend * t);
    }
    return out;
}

}  // namespace

SkyShade::SkyShade(const SurfaceSample& s, const ImageF1& weight_mean, const ImageF1& luma_detail,
                   int window_px) {
    const Window window(s, weight_mean, window_px);
    const auto fine = [&](const Turned& of) {
        return Turned{window.fine(of.along), window.fine(of.across),
                      window.fine(of.across_squared)};
    };
    Turned colours{turned(s, kRed, kBlue), turned(s, -kBlue, kRed), {}};
    colours.across_squared = squared(colours.across);
    const Turned details = fine(colours);
    const Turned wide{window.wide(details.along), window.wide(details.across),
                      window.wide(details.across_squared)};
    const ImageF1 wide_luma = window.wide(luma_detail);
    weight_of_paint_ = paint_weight(s, wide_luma, wide);
    const PaintPart paint = paint_part(details.along, details, s);
    presence_ = presence_of_shade(s, wide_luma, wide, paint);
    if (presence_ == 0) return;

    subtract(colours.along, paint, colours);
    for (ImageF1* plane : {&colours.along, &colours.across})
        *plane = along_edges(*plane, s);
    colours.across_squared = squared(colours.across);
    const Turned smooth = fine(colours);
    subtract(colours.along, paint_part(smooth.along, smooth, s), colours);
    light_taken_ = light_of(s, window, colours, wide_luma);
    subtract_mean(light_taken_, s.weight);
    for (std::size_t i = 0; i < count_of(light_taken_); ++i)
        light_taken_.data()[i] *= presence_;
}

void SkyShade::take_out(ImageF1& red_green, ImageF1& blue_green) const {
    if (presence_ == 0) return;
    for (std::size_t i = 0; i < count_of(red_green); ++i) {
        float& r = red_green.data()[i];
        float& b = blue_green.data()[i];
        const float along = presence_ * (r * kRed + b * kBlue);
        r -= along * kRed, b -= along * kBlue;
    }
}

}  // namespace weft
