#pragma once
// How steady a matte is: whether its edge moves with the picture.

#include <optional>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// How far outside a matte its edge is searched on the other frame, in pixels.
inline constexpr int kChatterReachPx = 8;

/// The mean distance, in pixels, between the edge of `to` and that of `from` moved along
/// `to_from_from`: Σ |to(p + d) − from(p)| over Σ |∇from(p)|, both of coverage 0–1, over the pixels
/// with a valid motion at most kChatterReachPx outside of `from`. A matte that sticks to its
/// surface has 0; one that is a pixel wider on every other frame has 1. What is hidden on one of
/// the frames has no valid motion and does not count. Empty if less than 16 px of edge are visible.
/// All H×W; `from` belongs to the frame on whose pixels the motion lies. Thread-safe.
[[nodiscard]] std::optional<double> matte_chatter_px(const FlowField& to_from_from, ViewU8x1 from,
                                                     ViewU8x1 to);

}  // namespace weft
