#pragma once
// Where a patch would merely touch what is there, instead of overlapping it.

#include <cstdint>
#include <vector>

#include "engine/synthesis/canvas.h"

namespace weft {

/// For every translation t ∈ [lo, hi], row by row: over how many pixels of its border a window of
/// the given size at t, cut to the block, meets filled pixels outside while it overlaps fewer than
/// `least_px` of them inside. A seam has no room there; at 0 px of overlap it is a butt joint.
[[nodiscard]] std::vector<std::uint32_t> thin_contacts(const Canvas& canvas, const Block& block,
                                                       Size window, Vec2i lo, Vec2i hi,
                                                       Vec2i least_px);

}  // namespace weft
