#pragma once
#include <algorithm>

#include "engine/motion/photometric_register.h"

namespace weft {

/// How far the picture fails to hold a surface that bends: against its anchors it is found poorly,
/// and not for long. Rendered figures that are followed to a pixel leave a residual of 0.2 to 0.35
/// against one anchor for the whole clip, a breakdancer filmed by hand 0.4 to 0.6 against a new one
/// on every second or third frame (unrelated pictures: 0.7). A goat whose coat glistens leaves 0.6,
/// yet is found by the same anchor for sixty frames, so it is held. Not thread-safe.
class FollowingDoubt {
  public:
    /// A frame against its anchor.
    void note(const RegistrationFit& fit) {
        const auto residual = static_cast<float>(fit.residual);
        residual_ = residual_ < 0 ? residual : residual_ + kGain * (residual - residual_);
        replaced_ -= kSlowGain * replaced_;
    }
    /// The frame took its anchor's place.
    void note_replaced() { replaced_ += kSlowGain; }
    /// From 0, the surface is held, to 1: what motion says of single places is not to be believed.
    [[nodiscard]] float share() const {
        const auto between = [](float value, float none, float all) {
            return std::clamp((value - none) / (all - none), 0.0f, 1.0f);
        };
        return between(residual_, 0.38f, 0.48f) * between(replaced_, 0.1f, 0.22f);
    }

  private:
    static constexpr float kGain = 0.25f, kSlowGain = 0.125f;
    float residual_ = -1, replaced_ = 0;  // means over some four and eight frames
};

}  // namespace weft
