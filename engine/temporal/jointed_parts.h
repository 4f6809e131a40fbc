#pragma once
// Internal to SurfaceWalker: a surface whose parts are followed by themselves.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/image.h"
#include "engine/mask/matte_propagation.h"
#include "engine/motion/lattice_field.h"
#include "engine/temporal/part_outlines.h"
#include "engine/temporal/step_motion.h"
#include "engine/temporal/surface_walker.h"

namespace weft {

/// The parts of a body with joints, such as arms in front of a torso. They are found by their
/// motion (find_moving_parts(), part_outlines()) on the step where it shows, and are kept apart
/// from then on: each is followed by a walker of its own, which begins as a copy of the one that
/// had followed it so far, and a part's outline is carried along as a painted matte is
/// (MatteWalker). What no part claims is the body, which is behind them and comes to light again by
/// its own motion. A copy walks on by itself. Not thread-safe.
class JointedParts {
  public:
    /// Whether any part was found yet.
    [[nodiscard]] bool any() const { return !parts_.empty(); }
    /// With the body; 0 before any part was found.
    [[nodiscard]] int count() const { return static_cast<int>(parts_.size()); }
    /// Looks for the first parts in the step that `whole` is about to take from `last`. Afterwards
    /// any() tells, and if so advance() takes the step.
    void look(const SurfaceWalker& whole, const std::shared_ptr<const StepFrame>& last,
              const WalkStep& to, const SurfaceWalkerOptions& options);
    /// Goes on to the next frame, and finds further parts in each of the present ones.
    void advance(const WalkStep& to, const SurfaceWalkerOptions& options);
    void hold();
    /// As SurfaceWalker's: `ref_from_here` is of all parts together.
    void anchor_here(const LatticeField* ref_from_here);

    /// Of all parts together, in each part's pixels its own, on a lattice that is finer than the
    /// parts': an edge of an arm is no slope of 8 px.
    [[nodiscard]] LatticeField ref_from_cur() const;
    [[nodiscard]] LatticeField prev_from_cur() const;

  private:
    struct Part {
        SurfaceWalker walker;
        std::shared_ptr<const StepFrame> last;  // the walk's last frame, with the part alone
        std::optional<MatteWalker> matte;       // none: the body, what is left by the others
    };
    // What a part is to become.
    struct Next {
        Matte matte;
        std::shared_ptr<const StepFrame> frame;
        StepEvidence evidence;
    };

    [[nodiscard]] std::vector<Next> propagated(const WalkStep& to);
    [[nodiscard]] std::vector<PartOutline> found_in(const Part& part, const Next& now,
                                                    const FlowField& prev_from_cur,
                                                    const SurfaceWalkerOptions& options) const;
    void split(std::size_t part, std::vector<Next>& next, const WalkStep& to,
               const SurfaceWalkerOptions& options);
    void drop_islands(std::size_t part, std::vector<Next>& next);
    void give_up_lost(std::vector<Next>& next);
    [[nodiscard]] LatticeField joined(const std::vector<LatticeField>& fields) const;

    std::vector<Part> parts_;       // the body first
    Image<std::uint8_t, 1> owner_;  // by pixel: index of its part, or kNobody
};

}  // namespace weft
