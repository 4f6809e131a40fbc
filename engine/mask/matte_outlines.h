#pragma once
// The outlines of a matte at half coverage, between pixels.

#include <vector>

#include "engine/core/image.h"
#include "engine/mask/outline_path.h"

namespace weft {

struct MatteOutline {
    OutlinePath path;    ///< Plate pixels; the matte's inside is on its right as it goes.
    int level = 0;       ///< How many others are around it: even, the matte is inside; odd, a hole.
    double area_px = 0;  ///< Inside of it, > 0.
};

/// The lines along which the coverage, linear between the centres of pixels, is a half: marching
/// squares, top left first. Where the matte reaches the picture's border they run a pixel outside
/// of it. Those around less than `least_area_px` are left out. Pure and thread-safe.
[[nodiscard]] std::vector<MatteOutline> outlines_of_matte(ViewU8x1 matte, double least_area_px);

}  // namespace weft
