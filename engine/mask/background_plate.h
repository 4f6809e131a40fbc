#pragma once
// What a walk has seen of a shape's surroundings, kept where the shape has since passed in front: a
// clean plate that moves with the background. What differs from it is not background.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

class BackgroundPlate {
  public:
    /// Everything of `frame` that lies clearly outside of the shape.
    BackgroundPlate(ViewU8x3 frame, ViewF1 phi);

    /// Moves the plate to the next frame. `background_from_cur`: where the background of each pixel
    /// of that frame lay in the plate, pixels.
    void move(ViewF2 background_from_cur);

    /// Log odds for inside on the frame that the plate was moved to: how badly the pixel agrees
    /// with the plate, measured by how badly the surroundings of the expected shape do. 0 where
    /// the plate is unknown. `frame` and `expected_phi` are cut to `area`, as the result.
    [[nodiscard]] ImageF1 odds(ViewU8x3 frame, ViewF1 expected_phi, const Recti& area) const;

    /// Takes over what is outside of the found shape.
    void learn(ViewU8x3 frame, ViewF1 phi);

  private:
    ImageU8x3 picture_;
    Image<std::uint8_t, 1> known_;
};

}  // namespace weft
