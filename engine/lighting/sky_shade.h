#pragma once
#include "engine/core/image.h"
#include "engine/lighting/surface_sample.h"

namespace weft {

/// Shade that the sky lights and the sun does not: darker, and bluer in proportion (the two
/// illuminants of Finlayson et al. 2004). Sun and sky differ along the locus of daylight, whose
/// direction in ln R/G and ln B/G is nearly the same at all times of the day, so the colours of a
/// surface have a part along it, which light changes, and a part across it, which only paint does.
class SkyShade {
  public:
    /// `window_px` of the small picture: differences within it are judged. `weight_mean`: the
    /// sample's weight under the box blur of that radius; `luma_detail`: high_pass() of its luma
    /// (masked_filters.h). `sample.box` must not be empty.
    SkyShade(const SurfaceSample& sample, const ImageF1& weight_mean, const ImageF1& luma_detail,
             int window_px);

    /// The sample's weight, reduced where a difference may be such shade and not paint.
    [[nodiscard]] const ImageF1& weight_of_paint() const { return weight_of_paint_; }
    /// Removes the colour of this shade from chromaticities (ln R/G and ln B/G, of the sample's
    /// size), so that they are equal in sun and shade.
    void take_out(ImageF1& red_green, ImageF1& blue_green) const;
    /// ln of the light that the shade takes away, relative to its mean, by the pixels' colours:
    /// how much of the sun's light is missing changes colour and lightness together, and how dark
    /// the paint is changes the colour of neither light. Empty if there is no such shade. Noise is
    /// averaged along the luma's own edges.
    [[nodiscard]] const ImageF1& light_taken() const { return light_taken_; }

  private:
    ImageF1 weight_of_paint_, light_taken_;
    float presence_ = 0;  // 0 to 1
};

}  // namespace weft
