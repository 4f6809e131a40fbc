#pragma once
// How steady a matte is: whether its edge goes where the picture goes.

#include <optional>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// How far outside a matte its edge is looked for on the other frame, in pixels.
inline constexpr int kChatterReachPx = 8;

/// By how many pixels the edge of `to` departs, on average, from that of `from` moved along
/// `to_from_from`: Σ |to(p + d) − from(p)| over Σ |∇from(p)|, both of coverage 0–1, over the pixels
/// with a valid motion at most kChatterReachPx outside of `from`. A matte that sticks to its
/// surface has 0; one that is a pixel wider on every other frame has 1. What is hidden on one of
/// the frames has no valid motion and does not count. Nothing where less than 16 px of edge are
/// seen. All of one size; `from` belongs to the frame on whose pixels the motion lies. Thread-safe.
[[nodiscard]] std::optional<double> matte_chatter_px(const FlowField& to_from_from, ViewU8x1 from,
                                                     ViewU8x1 to);

}  // namespace weft
