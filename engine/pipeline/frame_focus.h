#pragma once
#include "engine/pipeline/frame_light.h"

namespace weft {

/// Blurs a region's texture over its box as the plate is blurred there, times the region's focus
/// (method: "Grain and focus"). Only edges of paint tell the plate's focus: the edge of a shadow is
/// as soft as its penumbra. `inside`: the matte over the box. Errors: those of the source.
[[nodiscard]] Status match_focus(const FrameLight& light, ViewU8x1 inside, ImageF3& texture);

}  // namespace weft
