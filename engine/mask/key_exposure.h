#pragma once
// Internal to MatteWalker: frames as if the camera exposed them like the keyframe.

#include <array>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// A camera that exposes by itself, or balances its white anew, makes a whole picture brighter
/// within a second. What is known of colours stays true only on frames that are undone of it. The
/// change is measured from frame to frame along the motion: it is one number a channel, a gain of
/// dark and middle tones, of which the camera's curve leaves less the brighter a tone is. What
/// changes a part of the picture only, a shade or a lamp, is none. Not thread-safe.
class KeyExposure {
  public:
    /// `frame` as the keyframe's exposure would show it. `before`: what this has returned for the
    /// frame before, or the keyframe; `prev_from_cur` leads there. All H×W, display-encoded. Equal
    /// to `frame` where the exposure has changed by less than a twentieth since the keyframe.
    [[nodiscard]] ImageU8x3 evened(ViewU8x3 frame, ViewU8x3 before, const FlowField& prev_from_cur);

  private:
    std::array<float, 3> change_{};  // since the keyframe, natural logarithm, by channel
};

}  // namespace weft
