#pragma once
#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// Texture coordinates of `box` from a UV pass (H×W of the plate, 0–1, origin bottom left) on a
/// plane of `plane` texels. `scale` 2 shows the texture twice as large. On soft pixels a renderer
/// mixes the surface's coordinates with others; there they are continued in straight lines, up to
/// three pixels far, from the pixels that `matte` (of the box's size) covers wholly. Where edge
/// tools show more than that (`shown`, likewise) they are continued up to 256 pixels far.
[[nodiscard]] TextureCoords coords_from_uv(const ImageF2& uv, const Recti& box, ViewU8x1 matte,
                                           ViewU8x1 shown, Size plane, float scale);

}  // namespace weft
