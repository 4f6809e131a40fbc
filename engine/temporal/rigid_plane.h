#pragma once
// Whether a surface is one rigid plane, decided over the frames of a walk.

#include <optional>

#include "engine/temporal/anchors.h"
#include "engine/temporal/surface_kind.h"

namespace weft {

/// A smooth field follows some of the noise, people who pass in front draw it along, and where
/// stripes or a blank leave the motion open it invents one. So a surface counts as a rigid plane
/// for as long as nothing speaks against it: on several frames what bends must explain much of what
/// the plane leaves unexplained. How much, and not how surely, since a lens and a rolling shutter
/// bend every plane a little. Once refuted it stays so. Not thread-safe.
class RigidPlane {
  public:
    explicit RigidPlane(SurfaceKind kind = SurfaceKind::kFound);

    [[nodiscard]] bool believed() const { return believed_; }
    /// Whether somebody said so: nothing can refute it.
    [[nodiscard]] bool is_said() const { return said_; }
    /// Believed, and borne out by so many frames that no joints are looked for.
    [[nodiscard]] bool is_settled() const { return said_ || (believed_ && is_borne_out()); }
    /// Whether enough frames have shown it.
    [[nodiscard]] bool is_borne_out() const;
    /// It is none, whatever the frames show.
    void refute() { believed_ = said_ = false; }

    /// A frame registered as one homography, unless it speaks against that. `bent`: as registered
    /// without it. `initial`: anchor_from_cur as expected, a homography. `by_color`: as in
    /// register_against().
    [[nodiscard]] std::optional<Registered> registered(const Anchor& anchor, const StepFrame& cur,
                                                       bool by_color, const LatticeField& initial,
                                                       const Registered& bent, FlowQuality quality);

    /// Whether nothing has spoken against it for long, so that what bends is asked for on every
    /// fourth frame only, which takes most of the time.
    [[nodiscard]] bool may_be_taken_for_granted() const;
    /// As registered(), without asking; nothing where the plane does not explain the frame about as
    /// well as the one on which it was asked last.
    [[nodiscard]] std::optional<Registered> taken_for_granted(const Anchor& anchor,
                                                              const StepFrame& cur, bool by_color,
                                                              const LatticeField& initial,
                                                              FlowQuality quality);

  private:
    void note(bool speaks_against, const RegistrationFit& fit);

    bool believed_ = true, said_ = false;
    int borne_out_ = 0;      // frames that showed the plane
    double against_ = 0;     // frames that spoke against it, less half of those since that did not
    int granted_ = 0;        // frames since it was asked last
    RegistrationFit asked_;  // then; of the last frame that showed the surface
};

}  // namespace weft
