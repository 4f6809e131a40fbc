#pragma once
// The old surface's reflectance from several frames: at one place of the surface it is constant
// over time, and light is not (Weiss 2001; here the upper quantile of the lightness, which also
// removes fine moving shadows).

#include <array>
#include <cstddef>
#include <vector>

#include "engine/core/image.h"
#include "engine/lighting/shading.h"
#include "engine/lighting/surface_sample.h"

namespace weft {

/// ln reflectance on the downscaled picture of the reference frame. `box` may extend beyond that
/// picture. 0 where confidence is 0.
struct ClipReflectance {
    Recti box;
    ImageF1 value;
    ImageF1 confidence;       ///< Confidence, 0 to 1: the share of the frames that show the place.
    ImageF1 doubt;            ///< light_doubt() of what never moves there.
    PrintedMarks marks = {};  ///< That at least half of the frames show.
    /// How far the surface has a pattern, 0 to 1. Errors of the motion leave some of it in the
    /// light; where there is none, what remains of a frame is folds.
    float presence = 1;
};

/// Gathers a surface's frames. Not thread-safe.
class ReflectanceGatherer {
  public:
    explicit ReflectanceGatherer(const ShadingOptions& options) : options_(options) {}

    /// `ref_from_cur`: for every pixel of `sample.box`, the displacement to its place on the
    /// downscaled reference frame, in small pixels. Empty samples are ignored. All samples have the
    /// same downscale.
    void add(const SurfaceSample& sample, const ImageF2& ref_from_cur);
    /// The reflectance of places that at least three frames show. Empty if fewer were added.
    [[nodiscard]] ClipReflectance finish();

  private:
    struct Part {
        Recti box;
        ImageF1 luma, paint;  // of the frame, ln; without the shade that its colours tell
        ImageF1 weight;
        float level = 0;  // ln light that the whole frame has beyond others
        PrintedMarks marks;
        float printed = 0;  // SurfacePrint::confidence
    };
    template <typename Value>
    [[nodiscard]] ImageF1 over_time(const Recti& box, std::array<std::ptrdiff_t, 2> share,
                                    ImageF1& known, const Value& value, int step = 1) const;
    void find_levels(const Recti& box);
    [[nodiscard]] PrintedMarks usual_marks() const;
    [[nodiscard]] float pattern_px() const;

    int downscale_ = 1;
    ShadingOptions options_;
    std::vector<Part> parts_;
};

/// The shading of a frame, given the surface's reflectance from other frames. Where the frame does
/// not show that reflectance (lost motion, a changed surface), the estimate from the frame alone is
/// used. `ref_from_cur` as above.
[[nodiscard]] Shading shading_with(const SurfaceSample& sample, const ClipReflectance& reflectance,
                                   const ImageF2& ref_from_cur, const ShadingOptions& options);

}  // namespace weft
