#pragma once
// Which pixels of a walk are known by what they were on its keyframe, and which are guessed.

#include <cstdint>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// A step of the walk. Views have the frame's size but `surface_motion`, which has that of `area`.
struct FollowedStep {
    const FlowField& flow;  ///< prev_from_cur as measured, `valid` where it leads there and back.
    const Matte& parting;   ///< parting_pixels() of it and the whole frame.
    ViewF2 surface_motion;  ///< prev_from_cur of the surface, px.
    Recti area;             ///< Where the surface may be; empty once it has left the frame.
    ViewF1 prev_phi, phi;   ///< Signed distance of the matte on the frame before and on this one.
};

/// Which pixels of a walk's frame have been on their side of the matte's edge, in sight, since the
/// keyframe. What has come into the picture or out from behind something was not seen there, and
/// which side it is of is a guess, as is what came to be inside from outside. Not thread-safe.
class Followed {
  public:
    /// On the keyframe all is known.
    explicit Followed(Size frame) : known_(frame, kKnown) {}

    /// Goes on by a frame: what is inside along the surface's motion, the rest along its own, but
    /// not where motions part. Parallel over rows; deterministic.
    void advance(const FollowedStep& step);
    /// What is confirmed in `area` (is_confirmed) is known again.
    void know(ViewU8x1 area);

    /// kKnown or 0, H×W.
    [[nodiscard]] const Matte& known() const { return known_; }

    static constexpr std::uint8_t kKnown = 255;

  private:
    Matte known_;
};

}  // namespace weft
