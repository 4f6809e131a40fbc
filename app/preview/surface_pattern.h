#pragma once
// Internal to the overlays: patterns that show how a texture lies on the surface. Their cells have
// a size that suits the plate at the placement's `scale`.

#include "app/preview/preview.h"
#include "engine/core/fields.h"

namespace weft {

/// Fields that are alternately 255 and 0, with edges a pixel wide.
void draw_checker(const TextureCoords& coords, float scale, OverlayPicture& out);
/// A circle in every cell, two pixels wide.
void draw_circles(const TextureCoords& coords, float scale, OverlayPicture& out);

}  // namespace weft
