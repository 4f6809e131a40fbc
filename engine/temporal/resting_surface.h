#pragma once
// A faint surface in front of a camera that stands still.

#include <optional>

#include "engine/temporal/step_motion.h"

namespace weft {

/// Where `anchor` shows a surface that rests (rests_in_view()), anchor_from_cur, px. Pure;
/// deterministic.
[[nodiscard]] std::optional<Vec2> rests_where_seen(const StepFrame& anchor, const StepFrame& cur);

/// Whether the picture inside moves all the same, as a landscape does behind a window: motion finds
/// it again by far better than rest. `prev_from_cur`: of the step. Pure; deterministic.
[[nodiscard]] bool clearly_moves(const StepFrame& prev, const StepFrame& cur,
                                 const LatticeField& prev_from_cur);

}  // namespace weft
