#pragma once
// Fades to white and dissolves from it: the picture is mixed with white, so that its darks rise and
// its contrast falls.

#include "engine/core/image.h"

namespace weft {

/// The light of a picture, linear, display white 1.
struct LightRange {
    float low = 0, middle = 0, high = 0;  ///< 2nd, 50th and 98th percentile of the luminance.
};
/// Of the finite pixels of `linear`, where `visible` is 128 or more; an empty matte: everywhere.
/// Samples large pictures. Nothing seen: 0.
[[nodiscard]] LightRange light_range(ViewF3 linear, ViewU8x1 visible);

/// A frame's light: of the whole picture, and of the surface in it.
struct SurfaceLightRange {
    LightRange picture, surface;
};
/// The share of white in a frame, 0–1, next to a frame without any. More light alone raises the
/// contrast, and a bright thing beside the surface leaves the surface's darks: only what both the
/// picture's and the surface's darks, and the contrast, bear out is white. 0 below a twentieth.
[[nodiscard]] float white_share(const SurfaceLightRange& without, const SurfaceLightRange& frame);

}  // namespace weft
