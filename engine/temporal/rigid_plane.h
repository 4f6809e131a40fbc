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
    [[nodiscard]] bool is_settled() const;
    /// It is none, whatever the frames show.
    void refute() { believed_ = said_ = false; }

    /// A frame registered as one homography, unless it speaks against that. `bent`: as registered
    /// without it. `initial`: anchor_from_cur as expected, a homography. `by_color`: as in
    /// register_against().
    [[nodiscard]] std::optional<Registered> registered(const Anchor& anchor, const StepFrame& cur,
                                                       bool by_color, const LatticeField& initial,
                                                       const Registered& bent, FlowQuality quality);

  private:
    void note(bool speaks_against, const RegistrationFit& fit);

    bool believed_ = true, said_ = false;
    int borne_out_ = 0;   // frames that showed the plane
    double against_ = 0;  // frames that spoke against it, less half of those since that did not
};

}  // namespace weft
