#pragma once
// A surface in front of a camera that stands still, on two frames.

#include <optional>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// Where a surface that rests was on another frame, as far as all of the plate tells:
/// before_from_now in pixels, some tenths (about one where structure is coarse), by which a tripod
/// gives way; empty if it does not rest. A blank table or wall has nothing inside that says how it
/// moves, and what is measured there is the shade, the reflection or the edge of what passes. But
/// the camera stands still where a good part of what has structure anywhere in the plate is found
/// at its place again, and nowhere beside it; and the surface rests in front of it if its own edge
/// does: that before a background which rests as well. What moves before such a background by
/// itself does not rest, nor does what has structure that moves; edges of what passes, beyond which
/// nothing rests, say nothing. `before`, `now`: lumas; `visible`: the surface on the frame `now`,
/// all H×W. Pure; deterministic.
[[nodiscard]] std::optional<Vec2> rests_in_view(ViewU8x1 before, ViewU8x1 now, ViewU8x1 visible);

/// The share of the surface's places that have no structure by which motion could be told: 1 where
/// none has any. Both H×W. Pure; deterministic.
[[nodiscard]] double blank_share(ViewU8x1 luma, ViewU8x1 visible);

}  // namespace weft
