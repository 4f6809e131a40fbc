#pragma once
// Light that the artist paints.

#include <vector>

#include "engine/lighting/lamp.h"
#include "engine/lighting/shading.h"

namespace weft {

/// The product of all lamps on a frame; S₀ is 1. `full`: the plate's size.
[[nodiscard]] Shading painted_shading(const std::vector<Lamp>& lamps, int frame, Size full);

}  // namespace weft
