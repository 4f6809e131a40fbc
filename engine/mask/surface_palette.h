#pragma once
// The colours that a painted surface shows, against those of everything around it.

#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace weft {

class SurfacePalette {
  public:
    /// From the keyframe: the colours inside and outside of `phi`, away from its zero line. People
    /// paint loosely, and a bit of a hand that is painted with a cushion must not make hands the
    /// cushion's: within `rim_px` inside colours count an eighth of what deeper ones do.
    SurfacePalette(ViewU8x3 frame, ViewF1 phi, float rim_px = 0);

    /// Adds the colours of a later frame at the inner pixels of the found shape, so that the
    /// palette follows the light.
    void follow(ViewU8x3 frame, ViewF1 phi, float core_px);

    /// Log odds for the surface by colour alone, −4 to 4. Unknown to both: below 0.
    [[nodiscard]] float odds(const std::uint8_t* color) const;

    /// The log odds below which this share of the surface's own pixels lies.
    [[nodiscard]] float own_odds(float share) const;

  private:
    // How far from the zero line a pixel counts, and inside counts in full.
    struct Depths {
        float counted_px, sure_px;
    };
    void count(ViewU8x3 frame, ViewF1 phi, const Depths& depths, float keep);
    void tabulate();

    std::vector<float> inside_, outside_;  // shares by cell of the RGB cube
    std::vector<float> odds_;
};

}  // namespace weft
