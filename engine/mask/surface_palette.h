#pragma once
// The colours that a painted surface shows, against those of everything around it.

#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace weft {

class SurfacePalette {
  public:
    /// From the keyframe: the colours inside and outside of `phi`, away from its zero line.
    SurfacePalette(ViewU8x3 frame, ViewF1 phi);

    /// Adds the colours of a later frame at the inner pixels of the found shape, so that the
    /// palette follows the light.
    void follow(ViewU8x3 frame, ViewF1 phi, float core_px);

    /// Log odds for the surface by colour alone, −4 to 4. Unknown to both: below 0.
    [[nodiscard]] float odds(const std::uint8_t* color) const;

    /// The log odds below which this share of the surface's own pixels lies.
    [[nodiscard]] float own_odds(float share) const;

  private:
    void count(ViewU8x3 frame, ViewF1 phi, float clearance_px, float keep);
    void tabulate();

    std::vector<float> inside_, outside_;  // shares by cell of the RGB cube
    std::vector<float> odds_;
};

}  // namespace weft
