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
    /// ln of the light that the shade takes away, relative to its mean, by the pixels' colours:
    /// how much of the sun's light is missing changes colour and lightness together, and how dark
    /// the paint is changes the colour of neither light. Empty if there is no such shade, or if it
    /// does not explain the lightness. Noise is averaged along the luma's own edges.
    [[nodiscard]] ImageF1 light_taken(const SurfaceSample& sample) const;

  private:
    void fit_luma(const SurfaceSample& sample, const ImageF1& luma, const ImageF1& red,
                  const ImageF1& blue);

    ImageF1 weight_of_paint_;
    float red_ = 0, blue_ = 0;  // unit vector; 0 if there is no such shade
    float presence_ = 0;        // 0 to 1
    float luma_slope_ = 0;      // ln luma for each unit along it
    float explains_ = 0;        // 0 to 1: how far that explains the differences of luma
};

}  // namespace weft
