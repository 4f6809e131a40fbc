#pragma once
// Where a patch would only touch filled pixels instead of overlapping them.

#include <cstdint>
#include <vector>

#include "engine/synthesis/canvas.h"

namespace weft {

/// For every translation t ∈ [lo, hi], row by row: the number of pixels of its border at which a
/// window of the given size at t, clipped to the block, meets filled pixels outside while it
/// overlaps fewer than `least_px` of them inside. A seam has no room there; at 0 px of overlap it
/// is a butt joint.
[[nodiscard]] std::vector<std::uint32_t> thin_contacts(const Canvas& canvas, const Block& block,
                                                       Size window, Vec2i lo, Vec2i hi,
                                                       Vec2i least_px);

}  // namespace weft
