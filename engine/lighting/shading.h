#pragma once
// Light from the plate (method: "Lighting"; the paper, 2.4).

#include <optional>

#include "engine/core/image.h"
#include "engine/lighting/daylight.h"
#include "engine/lighting/surface_pattern.h"
#include "engine/lighting/surface_print.h"
#include "engine/lighting/surface_sample.h"

namespace weft {

enum class LightForm {
    kGain,  ///< Linear light: texture × (1 + λ (S/S₀ − 1)), gain within [least_gain, most_gain].
    kDetail,   ///< Display V: (λ Φ + (1−λ) B) · (V_T / B), B the base of the texture's V.
    kLiteral,  ///< Display V, eq. 8 as printed: λ Φ + (1−λ) V_T.
    // Baselines that use no shading (plate_transfer.h); apply_light() ignores them.
    kStatistics,  ///< Mean and deviation of the old surface's luma.
    kHistogram    ///< Its histogram.
};
/// Whether a form transfers statistics instead of a shading.
[[nodiscard]] constexpr bool is_transfer(LightForm form) {
    return form == LightForm::kStatistics || form == LightForm::kHistogram;
}
// V is max(R, G, B) under the sRGB curve, Φ the shading under it, B a Gaussian (σ 12 px) of V
// inside the matte, at least 0.02; V changes by scaling the encoded R, G, B with V'/V.

/// How the shading of a plate is estimated.
struct ShadingOptions {
    /// Structures smaller than this belong to the surface, not to the light (plate pixels at full
    /// size). Shadow edges of larger areas stay sharp. Contrast below about 10 % always counts as
    /// light.
    float pattern_px = 14;
    /// Works at 1/downscale of the plate (1, 2 or 4).
    int downscale = 2;
    /// Removes the part of the lightness that the surface's own colour explains.
    bool chromaticity = true;
    /// The shot's sun and sky. Empty: from the plate itself.
    std::optional<Daylight> daylight = {};
    /// The print on the surface, as one frame of the shot shows it. Empty: from the plate itself.
    std::optional<SurfacePrint> print = {};
};

/// The plate's shading: H/d × W/d, d the downscale (rounded up), linear light, > 0 everywhere;
/// estimated inside the matte, continued smoothly outside. Reflectance finer than pattern_px is
/// removed; edges of larger light and dark areas are sharp to a pixel of this image.
struct Shading {
    ImageF1 value;
    int downscale = 2;
    Size full;          ///< Size of the plate it belongs to.
    Matte inside = {};  ///< H/d × W/d, 255 where estimated, 0 where continued; empty: everywhere.
    /// H/d × W/d: how surely light and paint were told apart, 255 in full; empty: nothing had to be
    /// (a pass, a picture).
    Matte sure = {};
};

/// `linear`: plate in linear light, H×W×3; NaN and infinity are ignored. `visible`: the region's
/// matte without holdouts; pixels under 128 do not count, and the rim counts little. An empty matte
/// gives a shading of 1 everywhere. All functions of this header are thread-safe and bit-identical
/// for any number of threads.
[[nodiscard]] Shading estimate_shading(ViewF3 linear, ViewU8x1 visible,
                                       const ShadingOptions& options);

/// The two halves of estimate_shading(): the plate as the estimate sees it, with the part of its
/// luma that is paint; and the light in it.
[[nodiscard]] SurfaceSample light_sample(ViewF3 linear, ViewU8x1 visible,
                                         const ShadingOptions& options);
[[nodiscard]] Shading shading_of(const SurfaceSample& sample, const ShadingOptions& options);
struct LogShading {
    ImageF1 value;  ///< ln(S + floor) over the sample's box, unspecified where weight is 0.
    SurfacePattern pattern;  ///< What it was told from.
};
/// `sample` must not be empty.
[[nodiscard]] LogShading log_shading(const SurfaceSample& sample, const ShadingOptions& options);
/// The light in `still` (ln light without fine pattern): structures that are wider than `period_px`
/// of its pixels, or stronger than what may be left of `pattern` (ln reflectance). `weight`: the
/// confidence in each pixel. All H×W.
[[nodiscard]] ImageF1 light_beyond_period(const ImageF1& still, const ImageF1& weight,
                                          const ImageF1& pattern, float period_px);
/// Converts it to a Shading.
[[nodiscard]] Shading shading_from_log(const ImageF1& log, const SurfaceSample& sample);

/// Stabilises the shading over time: blends it with the previous frame's, warped along the motion,
/// where both agree within noise. The new shading is used where they disagree (a moving shadow, a
/// change of light), where the motion is NaN, and everywhere if the sizes differ. `prev_from_cur`:
/// full-size motion of the surface, pixels. A change of light wider than about 200 px is followed
/// at once, a smaller one as soon as it exceeds the noise.
[[nodiscard]] Shading steady_shading(const Shading& current, const Shading& previous,
                                     ViewF2 prev_from_cur);

/// S₀: the median of what is lit inside the matte, measured on the reference frame; 0.00001 if
/// nothing is.
[[nodiscard]] float median_shading(const Shading& shading, ViewU8x1 visible);

/// From an illumination picture E, stretched over `box` of a plate of `full` size (the paper).
[[nodiscard]] Shading shading_from_image(ViewF3 linear_picture, const Recti& box, Size full);

/// Shading from the artist's passes, exact at full size. A lighting pass is the shading itself;
/// from an albedo pass it is plate / albedo (linear light, the plate's size). Where a pass tells
/// nothing (not finite; an albedo that is black; light that is black where the plate has 0.02 or
/// more, since the pass does not cover it) it is filled from its surroundings.
[[nodiscard]] Shading shading_from_lighting(ViewF3 lighting, ViewF3 linear_plate);
[[nodiscard]] Shading shading_from_albedo(ViewF3 linear_plate, ViewF3 albedo);

struct LightOptions {
    LightForm form = LightForm::kGain;
    float strength = 1;  ///< λ, 0–1.
    /// Limits of the gain. Callers lift them for scene-linear output, where a patch of sun may be
    /// 100 times as bright as the rest.
    float least_gain = 0.125f, most_gain = 8.0f;
};

/// Lights `texture` (linear light, H×W×3, in place), whose pixel (0, 0) lies at `origin` on the
/// plate. Pixels where `matte` (same size and origin) is 0 may be left as they are. Strength 0, or
/// a shading equal to the reference, changes no bit; NaN in the texture stays where it is.
void apply_light(ImageView<float, 3> texture, Vec2i origin, ViewU8x1 matte, const Shading& shading,
                 float reference, const LightOptions& options);

}  // namespace weft
