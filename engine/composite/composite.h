#pragma once
// The new surface into the plate: O = F + M (T − B) (method: "Composite").

#include "engine/core/image.h"

namespace weft {

/// B: the old surface's colour, equal to the plate where `matte` is 255 and continued from there
/// into soft pixels (matte between 1 and 254); 0 elsewhere. Same space as `plate` (linear light).
/// NaN and infinity are left out and filled. H×W×3. In soft pixels it is what makes
/// O = F + M (T − B) the most likely picture: it takes the pixel's own share of the old pattern and
/// whatever a matte that is too wide or too narrow leaves, and so may lie outside the surface's
/// colours, or below 0, where matte and plate do not agree. Where the matte is 255 nowhere near, B
/// = F (the plain mix). Works within 96 px around the soft pixels.
[[nodiscard]] ImageF3 unmix_surface(ViewF3 plate, ViewU8x1 matte);

/// Writes O into `out` where matte > 0; where it is 0 `out` is not touched. Where matte is 255 it
/// is exactly T. All of one size; linear light. `plate` may hold NaN or infinity: there O = T,
/// channel by channel. Nothing is clipped above; below 0 only where the plate itself was not
/// negative.
void composite_over(ImageView<float, 3> out, ViewF3 plate, ViewF3 surface, ViewU8x1 matte,
                    ViewF3 texture);

/// Soft shoulder for display-referred output: identity up to `knee`, then approaches 1. Returns how
/// many pixels of the matte exceeded 1 before. Linear light. All three channels are scaled by what
/// the highest needs, so the hue stays; +infinity becomes 1, NaN beside a value above the knee 0.
/// Where the matte is soft the plate's share keeps its value; where it is 0 nothing is touched.
[[nodiscard]] long roll_off(ImageView<float, 3> rgb, ViewU8x1 matte, float knee = 0.9f);

}  // namespace weft
