#pragma once
// A faint surface in front of a camera that stands still.

#include "engine/temporal/step_motion.h"

namespace weft {

/// Whether a surface is where `anchor` shows it, as far as all of the plate tells. A blank table or
/// wall has nothing inside that says how it moves, and what is measured there is the shade, the
/// reflection or the edge of what passes. But the camera stands still where a good part of what
/// has structure anywhere in the plate is found at its place again, and nowhere beside it; and the
/// surface rests in front of it if its own edge does: that before a background which rests as well.
/// What moves before such a background by itself does not rest, and edges of what passes, beyond
/// which nothing rests, say nothing. Both frames are of one size. Pure; deterministic.
[[nodiscard]] bool rests_where_seen(const StepFrame& anchor, const StepFrame& cur);

/// Whether the picture inside moves all the same, as a landscape does behind a window: motion finds
/// it again by far better than rest. `prev_from_cur`: of the step. Pure; deterministic.
[[nodiscard]] bool clearly_moves(const StepFrame& prev, const StepFrame& cur,
                                 const LatticeField& prev_from_cur);

}  // namespace weft
