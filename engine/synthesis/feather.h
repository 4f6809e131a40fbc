#pragma once
// Feathering: blends across the seams of a finished plane.

#include <cstdint>

#include "engine/core/image.h"
#include "engine/synthesis/sample_atlas.h"

namespace weft {

/// The plane with each texel within `radius_px` of a seam blended linearly between the patches
/// there. Every texel q around p contributes the texture continued from q's source to p, with a
/// weight that falls to 0 at the radius. Texels whose neighbours all continue one patch keep their
/// value. With `wrap` the plane's opposite borders are neighbours. Pure.
[[nodiscard]] ImageU8x3 feather_seams(const SampleAtlas& atlas,
                                      ImageView<const std::int32_t, 2> source, int radius_px,
                                      bool wrap);

}  // namespace weft
