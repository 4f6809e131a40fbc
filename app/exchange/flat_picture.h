#pragma once
// A painted flat picture becomes a region's texture again.

#include <string>

#include "app/project/project.h"
#include "engine/core/error.h"
#include "engine/core/geometry.h"
#include "engine/pipeline/flat_layout.h"

namespace weft {

/// Texels a pixel of the plate that a flat picture may have.
inline constexpr int kMostFlatScale = 2;

/// How a picture of this size lies on the reference frame. Its size alone says it, since other
/// programs keep no other note of ours: once or twice the plate, and the same margin on all sides,
/// of less than half the plate's width. Errors: Usage for a size that no flat picture of this plate
/// has.
[[nodiscard]] Expected<FlatLayout> flat_layout_of(Size picture, Size plate);

/// The region with the picture in place of its texture: laid where it was gathered, in the plate's
/// light, with neither the exposure nor the colour of a new texture matched to the plate, and
/// without the placement, the form, the grade and the blending of the old one. The look of the
/// picture's camera (grain, focus, shutter), its mattes and its motion stay. `path`: as the project
/// is to name it. `space`: the picture's colour space; empty: as its file says.
[[nodiscard]] Region with_flat_picture(const Region& region, const std::string& path,
                                       const FlatLayout& layout, const std::string& space);

}  // namespace weft
