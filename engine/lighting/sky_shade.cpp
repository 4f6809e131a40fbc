#include "engine/lighting/sky_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/core/linear_system.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/bilateral_grid.h"
#include "engine/lighting/masked_filters.h"

namespace weft {
namespace {

// How much ln R/G falls and ln B/G rises per unit of ln luma when the sun's light is missing. Paint
// seldom does both; white beside indigo rises by more.
constexpr float kFaintestSky = 0.03f, kSky = 0.08f, kBluestSky = 0.35f, kBluerThanSky = 0.5f;
constexpr float kFaintShade = 0.08f, kShade = 0.2f;  // ln luma: not reliable below
constexpr int kDetail = 4;                           // of the window: paint may be finer
// Deviations that are too little to tell paints apart: of a chromaticity across daylight (ln), and
// of what along it does not go with the light.
constexpr double kOnePaintDeviation = 0.08, kNoRest = 0.05;
constexpr double kOfSquares = 0.25;
// The share of the colours' energy along daylight that the light explains, and how far its slope
// is from the shot's, in proportion.
constexpr double kChance = 0.4, kShared = 0.65, kSameSlope = 0.25, kOtherSlope = 0.5;
constexpr int kDraft = 4, kLeastWindow = 3;  // a draft's downscale; small pixels
constexpr double kOfBefore = 0.9;            // what earlier frames still say, for each frame
// What averages the noise of colours: small pixels, and ln luma.
constexpr float kSpace = 3.0f, kRange = 0.1f, kGuideSigma = 0.8f;

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

double total_of(const ImageF1& plane) {
    double sum = 0;
    for (std::size_t i = 0; i < count_of(plane); ++i)
        sum += plane.data()[i];
    return sum;
}

void subtract_mean(ImageF1& plane, const ImageF1& weight) {
    double sum = 0;
    for (std::size_t i = 0; i < count_of(plane); ++i)
        sum += static_cast<double>(weight.data()[i]) * plane.data()[i];
    const auto mean = static_cast<float>(sum / std::max(total_of(weight), 1e-6));
    for (std::size_t i = 0; i < count_of(plane); ++i)
        plane.data()[i] = weight.data()[i] > 0 ? plane.data()[i] - mean : 0.0f;
}

// The chromaticities in one direction; its mean is 0.
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

// The sample's weight, less where a wide difference looks like shade.
ImageF1 paint_weight(const ImageF1& weight, const ImageF1& luma, const ImageF1& along,
                     const ImageF1& across) {
    ImageF1 out(weight.size());
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const float a = along.row(y)[x], c = across.row(y)[x];
                const float shade =
                    looks_like_shade(luma.row(y)[x], kDaylightRed * a - kDaylightBlue * c,
                                     kDaylightBlue * a + kDaylightRed * c);
                out.row(y)[x] = weight.row(y)[x] * (1.0f - shade);
            }
        }
    });
    return out;
}

// Without noise, along the edges of the luma.
class EdgeFilter {
  public:
    explicit EdgeFilter(const SurfaceSample& s)
        : weight_(s.weight), guide_(weighted(s.luma, s.weight)) {
        ImageF1 total = s.weight;
        gaussian_blur(guide_, kGuideSigma);
        gaussian_blur(total, kGuideSigma);
        for (std::size_t i = 0; i < count_of(guide_); ++i)
            guide_.data()[i] /= std::max(total.data()[i], kLeastWeight);
    }
    [[nodiscard]] ImageF1 filtered(const ImageF1& plane) const {
        return joint_bilateral(weighted(plane, weight_), weight_, guide_, {kSpace, kRange});
    }

  private:
    const ImageF1& weight_;
    ImageF1 guide_;
};

// What light does not change.
struct Term {
    ImageF1 value, detail;  // detail: its fine differences
    double ridge = 0;       // variance that is noise
};

// `plane` less its regression on the terms; the relation is that of fine differences.
template <std::size_t N>
void regress_out(ImageF1& plane, const std::array<const Term*, N>& terms, const Window& window,
                 const ImageF1& weight) {
    const ImageF1 detail = window.fine(plane);
    std::array<const ImageF1*, N + 1> planes{};
    for (std::size_t k = 0; k < N; ++k)
        planes[k] = &terms[k]->detail;
    planes[N] = &detail;
    const auto m = moments_of<N + 1>(planes, weight);
    const double area = std::max(total_of(weight), 1.0);
    LinearSystem<N> system{};
    for (std::size_t i = 0; i < N; ++i) {
        std::copy_n(m[i].begin(), N + 1, system[i].begin());
        system[i][i] += terms[i]->ridge * area;
    }
    const std::array<double, N> c = solve(system);
    for (std::size_t i = 0; i < count_of(plane); ++i) {
        double explained = 0;
        for (std::size_t k = 0; k < N; ++k)
            explained += c[k] * terms[k]->value.data()[i];
        plane.data()[i] -= static_cast<float>(explained);
    }
    subtract_mean(plane, weight);
}

// Of wide differences only: fine ones are more likely paint.
DaylightEvidence evidence_of(const ImageF1& light, const ImageF1& sunlit, const Window& window,
                             const ImageF1& weight) {
    const ImageF1 wide_light = window.wide(window.fine(light));
    const ImageF1 wide_sunlit = window.wide(window.fine(sunlit));
    const auto m = moments_of<2>({&wide_light, &wide_sunlit}, weight);
    return {m[0][0], m[0][1], m[1][1]};
}

// How far the light explains the colours along daylight, less paint's part.
double share_of(const DaylightEvidence& e) {
    return e.light > 0 && e.colour > 0 ? e.both * e.both / (e.light * e.colour) : 0.0;
}

// The same as the shot's light does: 0 to 1.
float trust_in(const DaylightEvidence& e, float slope) {
    const double share = share_of(e);
    if (!(share > 0)) return 0;
    const double off = std::abs(e.both / e.light / slope - 1);
    return static_cast<float>(smooth_step(share, kChance, kShared) *
                              (1.0 - smooth_step(off, kSameSlope, kOtherSlope)));
}

DaylightEvidence pooled(const DaylightEvidence& now, const DaylightEvidence& before) {
    return {now.light + kOfBefore * before.light, now.both + kOfBefore * before.both,
            now.colour + kOfBefore * before.colour};
}

struct Found {
    ImageF1 light;
    DaylightEvidence evidence;
};

// The light is the luma less its regression on the colour across daylight and on what is left of
// the colour along it when the light's part, slope times luma, is taken out; squares and product
// for several paints. On a plain surface nothing is left, and all of the luma is light; where one
// paint has two lightnesses, the rest is in proportion to them.
Found find_light(const SurfaceSample& s, const ImageF1& along, const ImageF1& across,
                 const Window& window, float slope) {
    constexpr double kHueVariance = kOnePaintDeviation * kOnePaintDeviation,
                     kRestVariance = kNoRest * kNoRest;
    const EdgeFilter edges(s);
    const auto term = [&](ImageF1 value, double ridge) {
        ImageF1 detail = window.fine(value);
        return Term{std::move(value), std::move(detail), ridge};
    };
    ImageF1 sunlit = edges.filtered(along), light = s.luma;
    subtract_mean(light, s.weight);
    ImageF1 left = sunlit;
    for (std::size_t i = 0; i < count_of(left); ++i)
        left.data()[i] -= slope * light.data()[i];
    const Term hue = term(edges.filtered(across), kHueVariance);
    const Term hue2 = term(weighted(hue.value, hue.value), kOfSquares * kHueVariance);
    const Term rest = term(std::move(left), kRestVariance);
    const Term rest2 = term(weighted(rest.value, rest.value), kOfSquares * kRestVariance);
    const Term both = term(weighted(rest.value, hue.value), kOfSquares * kHueVariance);
    regress_out<5>(light, {&rest, &hue, &rest2, &both, &hue2}, window, s.weight);
    regress_out<2>(sunlit, {&hue, &hue2}, window, s.weight);
    const DaylightEvidence evidence = evidence_of(light, sunlit, window, s.weight);
    return {std::move(light), evidence};
}

// The means of 2 × 2 pixels: of noise, which hides from fine colours how the light goes with them,
// a quarter is left.
SurfaceSample halved(const SurfaceSample& s) {
    SurfaceSample out;
    out.box = {0, 0, (s.box.width() + 1) / 2, (s.box.height() + 1) / 2};
    out.weight = out.luma = out.red_green = out.blue_green = ImageF1(out.box.size());
    parallel_rows(out.box.height(), 8, [&](int y0, int y1) {
        for (int y = 2 * y0; y < std::min(2 * y1, s.box.height()); ++y) {
            for (int x = 0; x < s.box.width(); ++x) {
                const float w = 0.25f * s.weight.row(y)[x];
                out.weight.row(y / 2)[x / 2] += w;
                out.luma.row(y / 2)[x / 2] += w * s.luma.row(y)[x];
                out.red_green.row(y / 2)[x / 2] += w * s.red_green.row(y)[x];
                out.blue_green.row(y / 2)[x / 2] += w * s.blue_green.row(y)[x];
            }
        }
    });
    for (ImageF1* plane : {&out.luma, &out.red_green, &out.blue_green}) {
        for (std::size_t i = 0; i < count_of(*plane); ++i)
            plane->data()[i] /= std::max(out.weight.data()[i], kLeastWeight);
    }
    return out;
}

// At a draft's size.
DaylightEvidence coarse_evidence(const SurfaceSample& fine, int window_px, float slope) {
    const SurfaceSample s = halved(fine);
    const int radius = std::max(kLeastWindow, window_px / 2);
    ImageF1 mean = s.weight;
    box_blur(mean, radius);
    return find_light(s, turned(s, kDaylightRed, kDaylightBlue),
                      turned(s, -kDaylightBlue, kDaylightRed), Window(s, mean, radius), slope)
        .evidence;
}

}  // namespace

SkyShade::SkyShade(const SurfaceSample& s, const ImageF1& weight_mean, const ImageF1& luma_detail,
                   int window_px, const Daylight& shot_daylight) {
    const Window window(s, weight_mean, window_px);
    const ImageF1 along = turned(s, kDaylightRed, kDaylightBlue);
    const ImageF1 across = turned(s, -kDaylightBlue, kDaylightRed);
    weight_of_paint_ =
        paint_weight(s.weight, window.wide(luma_detail), window.wide(window.fine(along)),
                     window.wide(window.fine(across)));
    if (shot_daylight.confidence == 0) return;
    Found found = find_light(s, along, across, window, shot_daylight.slope);
    if (s.downscale < kDraft) {
        const DaylightEvidence coarse = coarse_evidence(s, window_px, shot_daylight.slope);
        if (share_of(coarse) > share_of(found.evidence)) found.evidence = coarse;
    }
    evidence_ = pooled(found.evidence, shot_daylight.before);
    confidence_ = shot_daylight.confidence * trust_in(evidence_, shot_daylight.slope);
    if (confidence_ == 0) return;
    light_ = std::move(found.light);
    for (std::size_t i = 0; i < count_of(light_); ++i)
        light_.data()[i] *= confidence_;
}

void SkyShade::take_out(ImageF1& red_green, ImageF1& blue_green) const {
    if (confidence_ == 0) return;
    for (std::size_t i = 0; i < count_of(red_green); ++i) {
        float& r = red_green.data()[i];
        float& b = blue_green.data()[i];
        const float along = confidence_ * (r * kDaylightRed + b * kDaylightBlue);
        r -= along * kDaylightRed, b -= along * kDaylightBlue;
    }
}

}  // namespace weft
