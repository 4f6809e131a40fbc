#pragma once
#include "engine/core/image.h"
#include "engine/lighting/surface_sample.h"

namespace weft {

/// Shade that the sky lights and the sun does not: darker, and bluer in proportion. Wide structures
/// with this relation are shade, others are paint (the two illuminants of Finlayson et al. 2004;
/// here a range of directions, because the camera is not known).
class SkyShade {
  public:
    /// `window_px` of the small picture: differences within it are judged. `weight_mean`: the
    /// sample's weight under the box blur of that radius; `luma_detail`: high_pass() of its luma
    /// (masked_filters.h). `sample.box` must not be empty.
    SkyShade(const SurfaceSample& sample, const ImageF1& weight_mean, const ImageF1& luma_detail,
             int window_px);

    /// The sample's weight, reduced where a difference is such shade and not paint.
    [[nodiscard]] const ImageF1& weight_of_paint() const { return weight_of_paint_; }
    /// Removes the colour of this shade from chromaticities (ln R/G and ln B/G, of the sample's
    /// size), so that they are equal in sun and shade.
    void take_out(ImageF1& red_green, ImageF1& blue_green) const;

  private:
    ImageF1 weight_of_paint_;
    float red_ = 0, blue_ = 0;  // unit vector; 0 if there is no such shade
    float presence_ = 0;        // 0 to 1
};

}  // namespace weft
