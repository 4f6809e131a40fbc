#pragma once
// Where the pixels of a walk's frames lay on its keyframe, pixels.

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// On the keyframe itself.
[[nodiscard]] ImageF2 own_places(Size size);

/// Where each pixel of `area` lay on the keyframe, from where the previous frame's pixels lay.
/// `prev_from_cur`: motion, of the area.
[[nodiscard]] ImageF2 follow_places(ViewF2 key_from_prev, ViewF2 prev_from_cur, const Recti& area);

}  // namespace weft
