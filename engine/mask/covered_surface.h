#pragma once
// Where a surface is behind something that passes in front of it.

#include "engine/core/image.h"
#include "engine/mask/background_plate.h"
#include "engine/mask/ground_step.h"

namespace weft {

/// What was inside and is not any more has something in front of it, until the surface is seen
/// there again. It goes on with the surface, and so does what it last looked like: what shows that
/// is the surface again, however much like others its colours are (a white jacket behind a hand,
/// before a white wall). Not thread-safe.
class CoveredSurface {
  public:
    /// `key_phi`: signed distance of the keyframe's matte, px.
    CoveredSurface(ViewU8x3 key_frame, ViewF1 key_phi);

    /// Goes on by a frame whose boundary is found. Parallel over rows; deterministic.
    void advance(const GroundStep& step);
    /// Of the pixels of that frame where `wrong` is not 0 it is known now on which side they are:
    /// the surface's own where `inside` is not 0, and else not hidden either.
    void correct(ViewU8x1 wrong, ViewU8x1 inside);
    /// Where the surface that pixel (x, y) of that frame shows or hides was on the frame before.
    [[nodiscard]] Vec2i place_before(int x, int y) const;
    /// Log odds, −3 to 3, that what the pixels of `frame`, that frame's, show is the surface again;
    /// 0 where nothing hid it, or what it looked like is not known. Parallel over rows.
    [[nodiscard]] ImageF1 odds(ViewU8x3 frame) const;

  private:
    ImageF2 motion_;  // prev_from_cur of what is hidden, px
    Matte frames_;    // for which what is inside has been so, up to those that make it its own
    Matte behind_;
    BackgroundPlate plate_;  // of the surface itself
};

}  // namespace weft
