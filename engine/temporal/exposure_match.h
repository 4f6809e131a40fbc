#pragma once
// Compares a surface that stands still with one that is blurred by its motion.

#include <array>
#include <optional>

#include "engine/temporal/anchors.h"

namespace weft {

/// The shutter of a shot as far as registration needs it. A picture that is blurred by motion is
/// drawn to wherever a sharp one happens to fit it, up to pixels away; both are therefore exposed
/// along the motion of the other one, and so are blurred alike (after Jin, Favaro & Cipolla 2005,
/// who track through motion blur by blurring what is compared). How long the shutter is open is
/// what explains the frames of the walk so far best. Not thread-safe.
class ExposureMatch {
  public:
    /// Learns from the frame `cur`, expected at `anchor_from_cur`. `motion`: of the step to it,
    /// prev_from_cur. Frames on which both move alike, or slowly, say nothing.
    void learn(const Anchor& anchor, const StepFrame& cur, const LatticeField& motion,
               const LatticeField& anchor_from_cur);
    /// The frame registered again from `initial`, both exposed alike, if that explains it clearly
    /// better than `sharp`, with the fit of that comparison.
    [[nodiscard]] std::optional<Registered> registered(const Anchor& anchor, const StepFrame& cur,
                                                       const LatticeField& motion,
                                                       const LatticeField& initial,
                                                       const Registered& sharp,
                                                       FlowQuality quality) const;
    /// How long the shutter is open, as a share of a frame; 0: not at all, or not known yet.
    [[nodiscard]] float open_share() const;

  private:
    static constexpr std::array<float, 4> kShares{0.25f, 0.5f, 0.75f, 1.0f};
    // In correlation, summed up over the frames: how well both agree if exposed alike, and how much
    // better than if each is exposed along its own motion again. Any blur makes noise and small
    // misses agree better; only where they were blurred before, one way does more than the other.
    std::array<double, kShares.size()> alike_{}, gains_{};
    int learnt_ = 0;  // frames
};

}  // namespace weft
