#pragma once
// Light that the artist paints.

#include <vector>

#include "engine/core/pixel_aspect.h"
#include "engine/lighting/lamp.h"
#include "engine/lighting/shading.h"

namespace weft {

/// The product of all lamps on a frame; S₀ is 1. `full`: the plate's size. Circles and angles are
/// those of the picture unsqueezed.
[[nodiscard]] Shading painted_shading(const std::vector<Lamp>& lamps, int frame, Size full,
                                      PixelAspect aspect = {});

}  // namespace weft
