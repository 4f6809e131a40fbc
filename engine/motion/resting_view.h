#pragma once
// A surface in front of a camera that stands still, on two frames.

#include "engine/core/image.h"

namespace weft {

/// Whether a surface is where it was on another frame, as far as all of the plate tells. A blank
/// table or wall has nothing inside that says how it moves, and what is measured there is the
/// shade, the reflection or the edge of what passes. But the camera stands still where a good part
/// of what has structure anywhere in the plate is found at its place again, and nowhere beside it;
/// and the surface rests in front of it if its own edge does: that before a background which rests
/// as well. What moves before such a background by itself does not rest, nor does what has
/// structure that moves; edges of what passes, beyond which nothing rests, say nothing. `before`,
/// `now`: lumas; `visible`: the surface on the frame `now`, all H×W. Pure; deterministic.
[[nodiscard]] bool rests_in_view(ViewU8x1 before, ViewU8x1 now, ViewU8x1 visible);

/// The share of the surface's places that have no structure by which motion could be told: 1 where
/// none has any. Both H×W. Pure; deterministic.
[[nodiscard]] double blank_share(ViewU8x1 luma, ViewU8x1 visible);

}  // namespace weft
