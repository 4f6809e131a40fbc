#pragma once
// Internal to resting_scene: a frame by blocks.

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// Means of `step` × `step` pixels, code values.
[[nodiscard]] ImageF3 reduced_floats(ViewU8x3 frame, int step);
[[nodiscard]] Vec3 color_at(const ImageF3& picture, int x, int y);
[[nodiscard]] ImageF1 luma_of(const ImageF3& picture);
/// The lumas of all its pixels, code values.
[[nodiscard]] Matte luma_codes(ViewU8x3 frame);
/// False for a black frame: it says nothing for a scene, and nothing against it.
[[nodiscard]] bool shows_anything(const ImageF1& luma);

}  // namespace weft
