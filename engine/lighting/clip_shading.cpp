// The shading of a frame, given the surface's reflectance from the whole clip.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/bilateral_grid.h"
#include "engine/lighting/clip_reflectance.h"
#include "engine/lighting/light_doubt.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/masked_statistics.h"

namespace weft {
namespace {

constexpr int kDetailRadius = 3;  // small pixels: the radius of detail
// Small pixels: the radius in which frame and reflectance are compared.
constexpr int kWindow = 12;
constexpr float kNoneShown = 0.35f,
                kAllShown = 0.7f;    // share of the reflectance's detail that shows
constexpr float kMinEnergy = 1e-5f;  // ln² of detail; below this it is noise
constexpr float kOutlier = 3.0f;     // deviations of the detail: larger residuals are light
// Small pixels, and ln units: of what is removed as noise, on a surface without pattern and on one
// whose pattern may be left.
constexpr float kPlainFineSpace = 0.7f, kPatternedFineSpace = 3.0f;
constexpr float kPlainFineSigma = 0.5f, kPatternedFineSigma = 1.0f, kFineRange = 0.08f;
constexpr int kFineRollings = 2;
constexpr float kShown = 0.5f;
constexpr std::int64_t kDoubtfulOneIn = 100;  // one in this many places may be in doubt

ImageF1 box_mean(const ImageF1& plane, const ImageF1& weight, const ImageF1& total, int radius) {
    ImageF1 mean = weighted(plane, weight);
    box_blur(mean, radius);
    for (std::size_t i = 0; i < mean.size_bytes() / sizeof(float); ++i)
        mean.data()[i] /= std::max(total.data()[i], 1e-4f);
    return mean;
}

ImageF1 detail_of(const ImageF1& plane, const ImageF1& weight, const ImageF1& total) {
    ImageF1 detail = box_mean(plane, weight, total, kDetailRadius);
    for (std::size_t i = 0; i < detail.size_bytes() / sizeof(float); ++i)
        detail.data()[i] = plane.data()[i] - detail.data()[i];
    return detail;
}

// Bilinear lookup of a canvas' plane; false where any corner is unknown.
bool look_up_canvas(const ClipReflectance& r, const ImageF1& plane, float u, float v, float& value,
                    float& confidence) {
    u -= static_cast<float>(r.box.x0), v -= static_cast<float>(r.box.y0);
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(r.box.width() - 1) &&
          v < static_cast<float>(r.box.height() - 1)))
        return false;
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    const float fx = u - static_cast<float>(x), fy = v - static_cast<float>(y);
    const float* t0 = r.confidence.pixel(x, y);
    const float* t1 = r.confidence.pixel(x, y + 1);
    confidence = std::min(std::min(t0[0], t0[1]), std::min(t1[0], t1[1]));
    if (!(confidence > 0)) return false;
    const float* a = plane.pixel(x, y);
    const float* b = plane.pixel(x, y + 1);
    const float top = a[0] + fx * (a[1] - a[0]), low = b[0] + fx * (b[1] - b[0]);
    value = top + fy * (low - top);
    return true;
}

// The reflectance as this frame shows it, and where it is known.
struct Seen {
    ImageF1 value, doubt, known;
};

Seen moved_here(const SurfaceSample& s, const ClipReflectance& r, const ImageF2& ref_from_cur) {
    Seen seen{ImageF1(s.box.size()), ImageF1(s.box.size()), ImageF1(s.box.size())};
    parallel_rows(s.box.height(), 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < s.box.width(); ++x) {
                if (s.weight.row(y)[x] == 0) continue;
                const float* d = ref_from_cur.pixel(x, y);
                const float u = static_cast<float>(x + s.box.x0) + d[0];
                const float v = static_cast<float>(y + s.box.y0) + d[1];
                float value = 0, doubt = 0, confidence = 0;
                if (!look_up_canvas(r, r.value, u, v, value, confidence)) continue;
                (void)look_up_canvas(r, r.doubt, u, v, doubt, confidence);
                seen.value.row(y)[x] = value;
                seen.doubt.row(y)[x] = doubt;
                seen.known.row(y)[x] = s.weight.row(y)[x] * confidence;
            }
        }
    });
    return seen;
}

// How much of the reflectance's detail the frame shows at its place, 0 to 1, by window: the slope
// of one on the other. Shadows and their edges exist in the frame only, so they are limited to the
// size of the reflectance's detail.
ImageF1 detail_shown(const SurfaceSample& s, const Seen& seen) {
    ImageF1 total = seen.known;
    box_blur(total, kDetailRadius);
    const ImageF1 frame = detail_of(s.luma, seen.known, total);
    const ImageF1 clip = detail_of(seen.value, seen.known, total);
    ImageF1 shown(s.box.size()), whole(s.box.size()), share(s.box.size());
    for (std::size_t i = 0; i < whole.size_bytes() / sizeof(float); ++i)
        whole.data()[i] = seen.known.data()[i] * clip.data()[i] * clip.data()[i];
    ImageF1 weight = seen.known;
    for (ImageF1* plane : {&whole, &weight})
        box_blur(*plane, kWindow);
    for (std::size_t i = 0; i < shown.size_bytes() / sizeof(float); ++i) {
        if (!(seen.known.data()[i] > 0)) continue;
        const float limit = kOutlier * std::sqrt(whole.data()[i] / weight.data()[i] + kMinEnergy);
        shown.data()[i] =
            seen.known.data()[i] * clip.data()[i] * std::clamp(frame.data()[i], -limit, limit);
    }
    box_blur(shown, kWindow);
    for (std::size_t i = 0; i < share.size_bytes() / sizeof(float); ++i) {
        if (!(seen.known.data()[i] > 0)) continue;
        const float least = kMinEnergy * weight.data()[i];
        share.data()[i] = smooth_step((shown.data()[i] + least) / (whole.data()[i] + least),
                                      kNoneShown, kAllShown);
    }
    return share;
}

// Removes noise, and what small errors of the motion leave of the pattern. The light's own edges
// stay, and all folds where there is no pattern.
ImageF1 without_noise(const ImageF1& luma, const ImageF1& weight, float presence) {
    const auto mixed = [presence](float plain, float patterned) {
        return plain + presence * (patterned - plain);
    };
    const ImageF1 values = weighted(luma, weight);
    ImageF1 guide = blurred(values, weight, mixed(kPlainFineSigma, kPatternedFineSigma)).value;
    const BilateralScale scale{mixed(kPlainFineSpace, kPatternedFineSpace), kFineRange};
    for (int i = 0; i < kFineRollings; ++i)
        guide = joint_bilateral(values, weight, guide, scale);
    return guide;
}

// True if almost no place needs the estimate from the frame alone, which costs more than everything
// else.
bool shows_all(const ImageF1& weight, const ImageF1& share) {
    std::int64_t all = 0, doubtful = 0;
    for (std::size_t i = 0; i < weight.size_bytes() / sizeof(float); ++i) {
        if (!(weight.data()[i] > 0)) continue;
        ++all;
        doubtful += share.data()[i] < kShown ? 1 : 0;
    }
    return doubtful * kDoubtfulOneIn <= all;
}

// Where motion is off by a pixel, the clip knows thin marks only faintly. The frame shows where
// they are; the light across them is the ground's.
ImageF1 unmarked(const SurfaceSample& s, const ImageF1& known, const PrintedMarks& marks,
                 const ShadingOptions& options) {
    const float pattern_px = std::max(1.0f, options.pattern_px / static_cast<float>(s.downscale));
    const ImageF1 ground = ground_between(marks, painted_luma(s), s.weight, pattern_px);
    ImageF1 out = known;
    for (std::size_t i = 0; i < out.size_bytes() / sizeof(float); ++i)
        if (!(ground.data()[i] > 0)) out.data()[i] = 0;
    return out;
}

// The sample without doubtful places; light is interpolated over them.
SurfaceSample known_part(const SurfaceSample& sample, const ImageF1& share) {
    SurfaceSample out;
    out.box = sample.box, out.downscale = sample.downscale, out.full = sample.full;
    out.floor = sample.floor;
    out.weight = sample.weight;
    for (std::size_t i = 0; i < share.size_bytes() / sizeof(float); ++i) {
        if (share.data()[i] < kShown) out.weight.data()[i] = 0;
    }
    return out;
}

}  // namespace

Shading shading_with(const SurfaceSample& sample, const ClipReflectance& reflectance,
                     const ImageF2& ref_from_cur, const ShadingOptions& options) {
    if (sample.box.empty() || reflectance.box.empty()) return shading_of(sample, options);
    const Seen seen = moved_here(sample, reflectance, ref_from_cur);
    const ImageF1 share = detail_shown(sample, seen);
    ImageF1 lit = sample.luma;
    for (std::size_t i = 0; i < lit.size_bytes() / sizeof(float); ++i)
        lit.data()[i] -= seen.value.data()[i];
    const ImageF1 ground = unmarked(sample, seen.known, reflectance.marks, options);
    ImageF1 light = without_noise(lit, ground, reflectance.presence);
    if (reflectance.marks.dark || reflectance.marks.light)
        bridge_marks(light, sample.weight, ground);
    ImageF1 doubt = seen.doubt;
    if (shows_all(sample.weight, share)) {
        const SurfaceSample known = known_part(sample, share);
        Shading out = shading_from_log(light, known);
        note_doubt(out, known, doubt);
        return out;
    }
    const LogShading log = log_shading(sample, options);
    const ImageF1& alone = log.value;
    const ImageF1 alone_doubt = light_doubt(sample, log, options);
    for (std::size_t i = 0; i < lit.size_bytes() / sizeof(float); ++i)
        light.data()[i] = alone.data()[i] + share.data()[i] * (light.data()[i] - alone.data()[i]);
    for (std::size_t i = 0; i < lit.size_bytes() / sizeof(float); ++i) {
        float& d = doubt.data()[i];
        d = alone_doubt.data()[i] + share.data()[i] * (d - alone_doubt.data()[i]);
    }
    Shading out = shading_from_log(light, sample);
    note_doubt(out, sample, doubt);
    return out;
}

}  // namespace weft
