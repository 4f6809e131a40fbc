#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/median.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/bilateral_grid.h"
#include "engine/lighting/fast_math.h"
#include "engine/lighting/light_doubt.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/masked_statistics.h"
#include "engine/lighting/quadratic_fit.h"
#include "engine/lighting/reflectance.h"
#include "engine/lighting/shading.h"
#include "engine/lighting/surface_pattern.h"
#include "engine/lighting/surface_print.h"
#include "engine/lighting/surface_sample.h"

namespace weft {
namespace {

// Scales, measured on clips whose true shading is known.
// Times the blur's; it may be wide because rolling guidance keeps edges.
constexpr float kRollingSigma = 2.5f;
// Times the deviation of what the blur leaves of the pattern.
constexpr float kRangeOfResidue = 2.5f;
constexpr float kMinRange = 0.06f, kMaxRange = 0.3f;  // ln units
constexpr int kRollings = 3;
// Smaller steps are smooth shading that rolling guidance has terraced.
constexpr float kStepRange = 0.4f;
constexpr float kStepSigma = 0.6f;  // times the blur's

constexpr float kRemains = 3.0f;  // deviations
// Of a pattern's deviation: the most that can be left of it.
constexpr float kMostLeftOfPattern = 0.12f;

// The share of the deviation from a quadratic that a quartic explains: below kFlatForm the surface
// is treated as flat, above kBentForm as curved. Measured: 0.05 on a wall, 0.17 on a ball.
constexpr float kFlatForm = 0.06f, kBentForm = 0.12f;

constexpr float kLeastRoot = 0.14f;  // of the median's root: 2 % of the median light

constexpr float kStillRange = 0.25f, kStillRemains = 0.25f;  // for light from a clip

// On a surface without pattern: of the blur of a patterned one, and of that in rolling guidance.
constexpr float kPlainSigma = 0.25f, kPlainRollingSigma = 0.8f;
// Of a print's pattern, what its paints tell; the rest are its edges. On computed checks 0.35
// leaves less of the checks and less of the folds, 0.5 more of both.
constexpr float kToldOfPrint = 0.42f;
// Small pixels: a filter is no narrower than one, or than what keeps a plain surface's wrinkles if
// the pattern's size is many pixels; else what is as fine may be paint.
constexpr float kFewPixels = 2.0f, kManyPixels = 5.0f;
constexpr float kPlainLeastPx = 0.7f;

// Median over the places where the plane is known.
float median_inside(const ImageF1& plane, const ImageF1& weight) {
    std::vector<float> values;
    for (int y = 0; y < plane.height(); y += 2) {
        for (int x = 0; x < plane.width(); x += 2) {
            if (weight.row(y)[x] > 0) values.push_back(plane.row(y)[x]);
        }
    }
    return median_of(values, 0.0f);
}

// After a blur, the remains of a pattern are wide and faint and look like light. Deviations from
// the surface's smooth light (a quadratic) that are no larger than such remains are removed by the
// non-negative garrote (Gao 1998), which keeps shadows.
void remove_remains(ImageF1& light, const ImageF1& weight, float pattern, float most) {
    const ImageF1 smooth = QuadraticFit(light, weight).surface();
    ImageF1 rest(light.size());
    for (std::size_t i = 0; i < rest.size_bytes() / sizeof(float); ++i)
        rest.data()[i] = light.data()[i] - smooth.data()[i];
    const ImageF1 none(light.size());
    const float deviation = deviation_between(rest, none, weight);
    // Where the light is not a quadratic, faint remains cannot be identified.
    const float fits = std::clamp(2.0f - deviation / std::max(1e-6f, most * pattern), 0.0f, 1.0f);
    const float limit = kRemains * deviation * fits;
    if (!(limit > 0)) return;
    parallel_rows(light.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < light.width(); ++x) {
                const float r = rest.row(y)[x];
                const float t = r * r > 0 ? limit * limit / (r * r) : 1.0f;
                light.row(y)[x] -= r * std::min(1.0f, t);
            }
        }
    });
}

float mixed(float plain, float patterned, float presence) {
    return plain + (patterned - plain) * presence;
}

// Rolling guidance (Zhang et al. 2014, eq. 5): the blur removes the pattern; filtering the
// unblurred luma with that result as the guide restores the edges of wider structures. Across the
// marks on a plain ground the light is that of the ground.
LogShading without_pattern(const SurfaceSample& sample, float pattern_px) {
    const ImageF1 luma = undecided_luma(sample);
    const ImageF1& weight = sample.weight;
    SurfacePattern pattern = surface_pattern(painted_luma(sample), luma, weight, pattern_px);
    pattern.presence *= 1 - kToldOfPrint * sample.print.confidence;
    const ImageF1& ground = pattern.ground;
    const float sigma = kPatternSigma * pattern_px * mixed(kPlainSigma, 1, pattern.presence);
    const ImageF1 weighted_luma = weighted(luma, ground);
    ImageF1 guide = blurred(weighted_luma, ground, sigma).value;
    const ImageF1 wide = blurred(weighted(guide, ground), ground, 2.0f * sigma).value;
    const float residue = deviation_between(guide, wide, ground);
    const float fine = smooth_step(pattern_px, kFewPixels, kManyPixels);
    const float least = mixed(mixed(1, kPlainLeastPx, fine), 1, pattern.presence);
    const BilateralScale rolling{
        std::max(least, mixed(kPlainRollingSigma, kRollingSigma, pattern.presence) * sigma),
        std::clamp(kRangeOfResidue * residue, kMinRange, kMaxRange)};
    for (int i = 0; i < kRollings; ++i)
        guide = joint_bilateral(weighted_luma, ground, guide, rolling);
    if (pattern.marks.dark || pattern.marks.light) bridge_marks(guide, weight, ground);
    ImageF1 light = joint_bilateral(weighted(guide, weight), weight, guide,
                                    {std::max(least, kStepSigma * sigma), kStepRange});
    remove_remains(light, weight, deviation_between(luma, light, weight),
                   kMostLeftOfPattern * pattern.presence);
    return {std::move(light), std::move(pattern)};
}

// A polynomial fit of the light's square root, returned as ln light. Where a body turns away from
// the light, light falls almost to 0 within a few pixels. ln light has a kink there that no
// polynomial follows; the light and its root have none.
ImageF1 fitted_form(const ImageF1& root, const ImageF1& weight, int degree) {
    ImageF1 form = PolynomialFit(root, weight, degree).surface();
    for (std::size_t i = 0; i < form.size_bytes() / sizeof(float); ++i)
        form.data()[i] = 2.0f * fast_log(std::max(kLeastRoot, form.data()[i]));
    return form;
}

// The part of the light that comes from the surface's form: what is smooth over the whole surface
// cannot be pattern. A quadratic is enough for a plane, and a higher degree would absorb a wide
// pattern. A ball, whose light falls off towards its outline, needs a quartic.
ImageF1 form_of(const ImageF1& still, const ImageF1& weight) {
    const float middle = median_inside(still, weight);
    ImageF1 level = still, root(still.size());
    for (std::size_t i = 0; i < root.size_bytes() / sizeof(float); ++i) {
        level.data()[i] -= middle;
        root.data()[i] = fast_exp(0.5f * level.data()[i]);
    }
    ImageF1 form = fitted_form(root, weight, 2);
    const ImageF1 bent = fitted_form(root, weight, 4);
    const float left = deviation_between(level, form, weight);
    const float gain = 1.0f - deviation_between(level, bent, weight) / std::max(1e-6f, left);
    const float share = smooth_step(gain, kFlatForm, kBentForm);
    for (std::size_t i = 0; i < form.size_bytes() / sizeof(float); ++i)
        form.data()[i] += middle + share * (bent.data()[i] - form.data()[i]);
    return form;
}

// A print's paints share a hue (teal, dark teal) or have none (black, white), of which a relation
// between colour and lightness tells little; where they are known, they tell all. What looks like
// the sky's light there is one of them.
void tell_by_print(SurfaceSample& sample) {
    const SurfacePrint& print = sample.print;
    if (!(print.confidence > 0)) return;
    const PrintedPaint printed = printed_paint(sample, print);
    const auto mix = [&](ImageF1& plane, const ImageF1& told) {
        for (std::size_t i = 0; i < plane.size_bytes() / sizeof(float); ++i)
            plane.data()[i] += print.confidence * (told.data()[i] - plane.data()[i]);
    };
    mix(sample.paint, printed.luma);
    mix(sample.weight, printed.weight);
    for (std::size_t i = 0; i < sample.daylight.size_bytes() / sizeof(float); ++i)
        sample.daylight.data()[i] *= 1 - print.confidence;
}

// pattern_px in pixels of the downscaled picture.
float small_pattern(const SurfaceSample& sample, const ShadingOptions& options) {
    return std::max(1.0f, options.pattern_px / static_cast<float>(sample.downscale));
}

}  // namespace

SurfaceSample light_sample(ViewF3 linear, ViewU8x1 visible, const ShadingOptions& options) {
    SurfaceSample sample = sample_surface(linear, visible, std::clamp(options.downscale, 1, 16));
    if (options.chromaticity && !sample.box.empty()) {
        ColourCues cues = colour_cues(
            sample, static_cast<int>(kChromaWindow * small_pattern(sample, options)) + 1,
            options.daylight ? *options.daylight : find_daylight(linear));
        sample.paint = std::move(cues.paint);
        sample.daylight = std::move(cues.light);
        sample.evidence = cues.evidence;
        sample.print = options.print ? *options.print : find_print(sample);
        tell_by_print(sample);
    }
    return sample;
}

LogShading log_shading(const SurfaceSample& sample, const ShadingOptions& options) {
    LogShading light = without_pattern(sample, small_pattern(sample, options));
    for (std::size_t i = 0; i < sample.daylight.size_bytes() / sizeof(float); ++i)
        light.value.data()[i] += sample.daylight.data()[i];
    return light;
}

ImageF1 light_beyond_period(const ImageF1& still, const ImageF1& weight, const ImageF1& pattern,
                            float period_px) {
    const float sigma = kPatternSigma * period_px;
    const ImageF1 form = form_of(still, weight);
    ImageF1 rest(still.size());
    for (std::size_t i = 0; i < rest.size_bytes() / sizeof(float); ++i)
        rest.data()[i] = weight.data()[i] * (still.data()[i] - form.data()[i]);
    ImageF1 light = blurred(rest, weight, sigma).value;
    for (int i = 0; i < kRollings; ++i)
        light = joint_bilateral(rest, weight, light, {kRollingSigma * sigma, kStillRange});
    const ImageF1 none(pattern.size());
    remove_remains(light, weight, deviation_between(pattern, none, weight), kStillRemains);
    for (std::size_t i = 0; i < light.size_bytes() / sizeof(float); ++i)
        light.data()[i] += form.data()[i];
    return light;
}

Shading shading_from_log(const ImageF1& log, const SurfaceSample& sample) {
    Shading shading{ImageF1(reduced_size(sample.full, sample.downscale), 1.0f), sample.downscale,
                    sample.full};
    if (sample.box.empty()) return shading;
    shading.inside = Matte(shading.value.size());
    parallel_rows(sample.box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < sample.box.width(); ++x) {
                if (sample.weight.row(y)[x] == 0) continue;
                const int u = x + sample.box.x0, v = y + sample.box.y0;
                shading.value.row(v)[u] = log.row(y)[x];
                shading.inside.row(v)[u] = 255;
            }
        }
    });
    fill_unknown(shading.value, shading.inside);
    parallel_rows(shading.value.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            float* row = shading.value.row(y);
            for (int x = 0; x < shading.value.width(); ++x)
                row[x] = std::max(fast_exp(row[x]) - sample.floor, 0.05f * sample.floor);
        }
    });
    return shading;
}

Shading shading_of(const SurfaceSample& sample, const ShadingOptions& options) {
    if (sample.box.empty()) return shading_from_log({}, sample);
    const LogShading log = log_shading(sample, options);
    Shading out = shading_from_log(log.value, sample);
    note_doubt(out, sample, light_doubt(sample, log, options));
    return out;
}

Shading estimate_shading(ViewF3 linear, ViewU8x1 visible, const ShadingOptions& options) {
    return shading_of(light_sample(linear, visible, options), options);
}

}  // namespace weft
