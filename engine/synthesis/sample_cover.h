#pragma once
// A plane that shows the sample itself: repeated, mirrored or stretched.

#include "engine/synthesis/texture_plane.h"

namespace weft {

/// The part of a sample that tiles: whole periods if it has any, otherwise all of it.
[[nodiscard]] Recti tiling_part(ViewU8x3 sample);

/// Covers a plane of the options' size by their mode, one of shows_sample(). Stretched pixels are
/// interpolated (bilinear); the source map then holds the nearest ones.
[[nodiscard]] TexturePlane lay_sample(ViewU8x3 sample, const PlaneOptions& options);

}  // namespace weft
