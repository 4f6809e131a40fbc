#pragma once
// Blending across the seams of a finished plane.

#include <cstdint>

#include "engine/core/image.h"
#include "engine/synthesis/sample_atlas.h"

namespace weft {

/// The plane with each texel within `radius_px` of a seam blended linearly between the patches
/// there: every texel q around p votes, with a weight that falls to 0 at the radius, for the
/// texture continued from q's source to p. Texels whose neighbours all continue one patch keep
/// their value. With `wrap` the plane's opposite borders are neighbours. Pure.
[[nodiscard]] ImageU8x3 feather_seams(const SampleAtlas& atlas,
                                      ImageView<const std::int32_t, 2> source, int radius_px,
                                      bool wrap);

}  // namespace weft
