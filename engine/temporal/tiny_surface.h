#pragma once
// Surfaces of a few pixels across: smaller than the patches of the estimated motion, which follows
// what is around them, and than what registration leaves out along their edges.

#include "engine/temporal/anchors.h"
#include "engine/temporal/step_motion.h"

namespace weft {

/// True if hardly anything of the surface lies more than a few pixels inside of its matte.
[[nodiscard]] bool is_tiny(const StepFrame& frame);

/// prev_from_cur of a tiny surface: of the raw motion `by_picture`, the outline's and the mattes'
/// own displacement the one under which pictures and mattes agree best, moved by up to some pixels
/// so that they agree more. All of one lattice. Pure; deterministic.
[[nodiscard]] LatticeField tiny_motion(const StepFrame& prev, const StepFrame& cur,
                                       const LatticeField& by_picture,
                                       const LatticeField& by_outline);

/// A tiny surface registered against an anchor, from `initial`, by its displacement alone. Pure;
/// deterministic.
[[nodiscard]] Registered register_tiny(const Anchor& anchor, const StepFrame& cur,
                                       const LatticeField& initial);

}  // namespace weft
