#pragma once
// The new surface into the plate: O = F + M (T − B) (method: "Composite").

#include "engine/core/image.h"

namespace weft {

/// B: the old surface's colour, equal to the plate where `matte` is 255 and continued from there into
/// soft pixels (matte between 1 and 254); 0 elsewhere. Same space as `plate` (linear light). NaN and
/// infinity are left out and filled. H×W×3.
[[nodiscard]] ImageF3 unmix_surface(ViewF3 plate, ViewU8x1 matte);

/// Writes O into `out` where matte > 0; where it is 0 `out` is not touched. Where matte is 255 it is
/// exactly T. All of one size; linear light. `plate` may hold NaN or infinity: there O = T.
void composite_over(ImageView<float, 3> out, ViewF3 plate, ViewF3 surface, ViewU8x1 matte, ViewF3 texture);

/// Soft shoulder for display-referred output: identity up to `knee`, then approaches 1. Returns how
/// many pixels of the matte exceeded 1 before. Linear light.
[[nodiscard]] long roll_off(ImageView<float, 3> rgb, ViewU8x1 matte, float knee = 0.9f);

}  // namespace weft
