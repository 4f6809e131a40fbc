#pragma once
#include "engine/core/image.h"
#include "engine/lighting/surface_sample.h"

namespace weft {

/// The shade in which the sun is missing and the sky remains: darker, and bluer by an amount that
/// goes with it. Told from paint by that relation where it is wide (the two illuminants of
/// Finlayson et al. 2004, here as a range of directions, since the camera is not known).
class SkyShade {
  public:
    /// `window_px` of the small picture: differences within it are judged. `weight_mean`: the
    /// sample's weight under the box blur of that radius; `luma_detail`: high_pass() of its luma
    /// (masked_filters.h). `sample.box` must not be empty.
    SkyShade(const SurfaceSample& sample, const ImageF1& weight_mean, const ImageF1& luma_detail,
             int window_px);

    /// The sample's weight, lower where a difference is such shade, not paint.
    [[nodiscard]] const ImageF1& weight_of_paint() const { return weight_of_paint_; }
    /// Takes the colour that this shade has, as far as there is any, out of chromaticities (ln R/G
    /// and ln B/G of the sample's size): what is left is the same in sun and shade.
    void take_out(ImageF1& red_green, ImageF1& blue_green) const;

  private:
    ImageF1 weight_of_paint_;
    float red_ = 0, blue_ = 0;  // the direction, of length 1, or 0 where there is no shade
    float presence_ = 0;        // 0 to 1
};

}  // namespace weft
