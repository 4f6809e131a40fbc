#pragma once
#include "engine/core/image.h"
#include "engine/lighting/daylight.h"
#include "engine/lighting/surface_sample.h"

namespace weft {

/// Shade that the sky lights and the sun does not: darker, and bluer in proportion (the two
/// illuminants of Finlayson et al. 2004). What differs across daylight's direction is paint, and so
/// is lightness that does not go with the colour along it as the shot's light does.
class SkyShade {
  public:
    /// `window_px` of the small picture: differences within it are judged. `weight_mean`: the
    /// sample's weight under the box blur of that radius; `luma_detail`: high_pass() of its luma
    /// (masked_filters.h). `sample.box` must not be empty.
    SkyShade(const SurfaceSample& sample, const ImageF1& weight_mean, const ImageF1& luma_detail,
             int window_px, const Daylight& shot_daylight);

    /// The sample's weight, reduced where a difference may be such shade and not paint.
    [[nodiscard]] const ImageF1& weight_of_paint() const { return weight_of_paint_; }
    /// Removes the colour of this shade from chromaticities (ln R/G and ln B/G, of the sample's
    /// size), so that they are equal in sun and shade.
    void take_out(ImageF1& red_green, ImageF1& blue_green) const;
    /// ln of the light in the sample, relative to its mean: its luma, less what the part of its
    /// colours tells that such light does not change. Empty if the shot has no such light.
    [[nodiscard]] const ImageF1& light() const { return light_; }
    /// For Daylight::before of the surface's next frame.
    [[nodiscard]] const DaylightEvidence& evidence() const { return evidence_; }

  private:
    ImageF1 weight_of_paint_, light_;
    DaylightEvidence evidence_;
    float confidence_ = 0;
};

}  // namespace weft
