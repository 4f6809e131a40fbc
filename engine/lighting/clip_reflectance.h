#pragma once
// The old surface's reflectance from several frames: it is constant at one place of the surface
// over time, light is not (Weiss 2001; here the upper quantile of the lightness itself, which
// leaves moving shadows out however fine they are).

#include <array>
#include <cstddef>
#include <vector>

#include "engine/core/image.h"
#include "engine/lighting/shading.h"
#include "engine/lighting/surface_sample.h"

namespace weft {

/// ln of the reflectance on the small picture of the reference frame, which may lie partly outside
/// of it. 0 where trust is 0.
struct ClipReflectance {
    Recti box;
    ImageF1 value;
    ImageF1 trust;  ///< 0 to 1: in how many of the frames the place was seen.
};

/// Gathers a surface's frames. Not thread-safe.
class ReflectanceGatherer {
  public:
    explicit ReflectanceGatherer(const ShadingOptions& options) : options_(options) {}

    /// `ref_from_cur`: for every pixel of `sample.box` where it was on the small picture of the
    /// reference frame, as a displacement in small pixels. Empty samples add nothing. All samples
    /// have one downscale.
    void add(const SurfaceSample& sample, const ImageF2& ref_from_cur);
    /// What at least three frames agree on. Empty when fewer were added.
    [[nodiscard]] ClipReflectance finish();

  private:
    struct Part {
        Recti box;
        ImageF1 luma, paint;  // of the frame, ln
        ImageF1 weight;
        float level = 0;  // ln light that the whole frame has beyond others
    };
    template <typename Value>
    [[nodiscard]] ImageF1 over_time(const Recti& box, std::array<std::ptrdiff_t, 2> share,
                                    ImageF1& known, const Value& value, int step = 1) const;
    void find_levels(const Recti& box);

    int downscale_ = 1;
    ShadingOptions options_;
    std::vector<Part> parts_;
};

/// The shading of a frame with the surface's reflectance known from other frames. Where the frame
/// does not show that reflectance (motion was lost, the surface has changed) the estimate from the
/// frame alone stands. `ref_from_cur` as above.
[[nodiscard]] Shading shading_with(const SurfaceSample& sample, const ClipReflectance& reflectance,
                                   const ImageF2& ref_from_cur, const ShadingOptions& options);

}  // namespace weft
