#pragma once
// Internal to resting_scene: how the light of a scene changes.

#include "engine/core/image.h"

namespace weft {

/// How many times as bright as `expected` each block of `luma` is; all of one size. Smooth, and
/// that of most of what is around: a thing in front has another brightness, but is no shade. What
/// is 0 in `expected`, or not 0 in `left_out`, does not count. 1 if nothing does. Deterministic.
[[nodiscard]] ImageF1 scene_gain(const ImageF1& expected, const ImageF1& luma,
                                 const Matte& left_out);

}  // namespace weft
