#pragma once
// A faint surface in front of a camera that stands still.

#include "engine/temporal/step_motion.h"

namespace weft {

/// Whether a surface is where `anchor` shows it (rests_in_view()). Pure; deterministic.
[[nodiscard]] bool rests_where_seen(const StepFrame& anchor, const StepFrame& cur);

/// Whether the picture inside moves all the same, as a landscape does behind a window: motion finds
/// it again by far better than rest. `prev_from_cur`: of the step. Pure; deterministic.
[[nodiscard]] bool clearly_moves(const StepFrame& prev, const StepFrame& cur,
                                 const LatticeField& prev_from_cur);

}  // namespace weft
