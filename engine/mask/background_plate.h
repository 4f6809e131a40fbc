#pragma once
// A clean plate of a shape's surroundings that moves with the background. It keeps what was visible
// before the shape passed in front. What differs from it is not background.

#include <cstdint>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

class BackgroundPlate {
  public:
    /// Starts with everything of `frame` that lies clearly outside the shape.
    BackgroundPlate(ViewU8x3 frame, ViewF1 phi);

    /// Moves the plate to the next frame. `background_from_cur`: where the background of each pixel
    /// of that frame lay in the plate, pixels.
    void move(ViewF2 background_from_cur);

    /// Log odds for inside on the frame that the plate was moved to: how badly a pixel agrees with
    /// the plate, relative to how badly the surroundings of the expected shape do. 0 where the
    /// plate is unknown. `surface_difference`: how badly it agrees with the surface, 8-bit levels,
    /// −1 where that is unknown; may be empty. `frame`, the other views and the result cover
    /// `area`.
    [[nodiscard]] ImageF1 odds(ViewU8x3 frame, ViewF1 expected_phi, ViewF1 surface_difference,
                               const Recti& area) const;

    /// How far a colour is from what the plate shows around pixel (x, y), but for light: the mean
    /// over channels, 8-bit levels; −1 where the plate is unknown.
    [[nodiscard]] float difference(const std::uint8_t* color, int x, int y) const;

    /// Adds what lies outside the found shape.
    void update(ViewU8x3 frame, ViewF1 phi);
    /// What is not 0 here was taken for background by mistake, on the frame of the last update.
    void forget(ViewU8x1 where);

  private:
    ImageU8x3 picture_;
    Image<std::uint8_t, 1> known_;
};

}  // namespace weft
