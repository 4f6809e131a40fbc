#include "engine/lighting/sky_shade.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/bilateral_grid.h"
#include "engine/lighting/masked_filters.h"

namespace weft {
namespace {

// How much ln R/G falls and ln B/G rises per unit of ln luma when the sun's light is missing
// (daylight of 2,500 K to 6,500 K over a sky of 7,000 K to 20,000 K). Paint seldom does both; white
// beside indigo rises by more.
constexpr float kFaintestSky = 0.03f, kSky = 0.08f, kBluestSky = 0.35f, kBluerThanSky = 0.5f;
constexpr float kFaintShade = 0.08f, kShade = 0.2f;  // ln luma: not reliable below
constexpr int kDetail = 4;                           // of the window: paint may be finer
constexpr float kLeastWeight = 1e-3f;
// Share of the wide differences' energy that is such shade; up to kNoShade it is chance.
constexpr float kNoShade = 0.5f, kSomeShade = 0.8f;

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

// The share of the wide differences' energy that the shade's colour has to explain.
constexpr double kExplainsLittle = 0.5, kExplainsMost = 0.75;
// What averages the noise of the colours: small pixels, and ln luma.
constexpr float kShadeSpace = 5.0f, kShadeRange = 0.15f, kGuideSigma = 0.8f;

struct Sums {
    double all = 0, shade = 0;  // energy of ln luma
    double red = 0, blue = 0;   // moments of the shade's chromaticity with its luma
};

}  // namespace

SkyShade::SkyShade(const SurfaceSample& s, const ImageF1& weight_mean, const ImageF1& luma_detail,
                   int window_px)
    : weight_of_paint_(s.box.size()) {
    const int around = std::max(1, window_px / kDetail);
    ImageF1 near = s.weight;
    box_blur(near, around);
    const auto wide = [&](const ImageF1& detail) {
        ImageF1 d = weighted(detail, s.weight);
        box_blur(d, around);
        for (std::size_t i = 0; i < d.size_bytes() / sizeof(float); ++i)
            d.data()[i] /= std::max(near.data()[i], kLeastWeight);
        return d;
    };
    const ImageF1 red = wide(high_pass(s.red_green, s.weight, weight_mean, window_px));
    const ImageF1 blue = wide(high_pass(s.blue_green, s.weight, weight_mean, window_px));
    const ImageF1 luma = wide(luma_detail);
    std::vector<Sums> rows(static_cast<std::size_t>(s.box.height()));
    parallel_rows(s.box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            Sums sums;
            for (int x = 0; x < s.box.width(); ++x) {
                const float l = luma.row(y)[x], r = red.row(y)[x], b = blue.row(y)[x];
                const float shade = looks_like_shade(l, r, b), w = s.weight.row(y)[x];
                weight_of_paint_.row(y)[x] = w * (1.0f - shade);
                const double energy = static_cast<double>(w) * l;
                sums.all += energy * l, sums.shade += shade * energy * l;
                sums.red += shade * energy * r, sums.blue += shade * energy * b;
            }
            rows[static_cast<std::size_t>(y)] = sums;
        }
    });
    Sums all;
    for (const Sums& r : rows)
        all.all += r.all, all.shade += r.shade, all.red += r.red, all.blue += r.blue;
    const double length = std::hypot(all.red, all.blue);
    if (!(all.all > 0 && length > 0)) return;
    red_ = static_cast<float>(all.red / length), blue_ = static_cast<float>(all.blue / length);
    presence_ = smooth_step(static_cast<float>(all.shade / all.all), kNoShade, kSomeShade);
    if (presence_ > 0) fit_luma(s, luma, red, blue);
}

// The regression of luma on the colour along the shade's direction.
void SkyShade::fit_luma(const SurfaceSample& s, const ImageF1& luma, const ImageF1& red,
                        const ImageF1& blue) {
    struct Moments {
        double luma2 = 0, both = 0, along2 = 0;
    };
    std::vector<Moments> rows(static_cast<std::size_t>(s.box.height()));
    parallel_rows(s.box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            Moments m;
            for (int x = 0; x < s.box.width(); ++x) {
                const double w = s.weight.row(y)[x], l = luma.row(y)[x];
                const double along = red.row(y)[x] * red_ + blue.row(y)[x] * blue_;
                m.luma2 += w * l * l, m.both += w * l * along, m.along2 += w * along * along;
            }
            rows[static_cast<std::size_t>(y)] = m;
        }
    });
    Moments all;
    for (const Moments& m : rows)
        all.luma2 += m.luma2, all.both += m.both, all.along2 += m.along2;
    if (!(all.luma2 > 0 && all.along2 > 0)) return;
    luma_slope_ = static_cast<float>(all.both / all.along2);
    explains_ = static_cast<float>(smooth_step(all.both * all.both / (all.luma2 * all.along2),
                                               kExplainsLittle, kExplainsMost));
}

ImageF1 SkyShade::light_taken(const SurfaceSample& s) const {
    const float share = presence_ * explains_;
    if (!(share > 0)) return {};
    ImageF1 taken(s.box.size());
    double sum = 0, total = 0;
    for (int y = 0; y < s.box.height(); ++y) {
        for (int x = 0; x < s.box.width(); ++x) {
            const float along = s.red_green.row(y)[x] * red_ + s.blue_green.row(y)[x] * blue_;
            taken.row(y)[x] = share * luma_slope_ * along;
            sum += static_cast<double>(s.weight.row(y)[x]) * taken.row(y)[x];
            total += s.weight.row(y)[x];
        }
    }
    const auto mean = static_cast<float>(sum / std::max(total, 1e-6));
    for (std::size_t i = 0; i < taken.size_bytes() / sizeof(float); ++i)
        taken.data()[i] = s.weight.data()[i] * (taken.data()[i] - mean);
    ImageF1 guide = weighted(s.luma, s.weight), weight = s.weight;
    gaussian_blur(guide, kGuideSigma);
    gaussian_blur(weight, kGuideSigma);
    for (std::size_t i = 0; i < guide.size_bytes() / sizeof(float); ++i)
        guide.data()[i] /= std::max(weight.data()[i], kLeastWeight);
    return joint_bilateral(taken, s.weight, guide, {kShadeSpace, kShadeRange});
}

void SkyShade::take_out(ImageF1& red_green, ImageF1& blue_green) const {
    if (presence_ == 0) return;
    for (std::size_t i = 0; i < red_green.size_bytes() / sizeof(float); ++i) {
        float& r = red_green.data()[i];
        float& b = blue_green.data()[i];
        const float along = presence_ * (r * red_ + b * blue_);
        r -= along * red_, b -= along * blue_;
    }
}

}  // namespace weft
