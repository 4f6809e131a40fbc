#pragma once
// Which of two motions the picture supports.

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// A frame and the one before it in a walk, display codes. `frame` is the part of it in `area`.
struct FramePair {
    ViewU8x3 frame, prev_frame;
    Recti area;
};

/// How far the picture speaks against the motion `motion` (prev_from_cur, px) at pixel `at` of the
/// frame, and for `other`, 0 to 1: by how much less its 5×5 surroundings change along `other`. What
/// is plain moves with anything: 0. Thread-safe.
[[nodiscard]] float speaks_against(const FramePair& pair, Vec2i at, Vec2 motion, Vec2 other);

}  // namespace weft
