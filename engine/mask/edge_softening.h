#pragma once
#include "engine/core/image.h"

namespace weft {

/// True when practically every pixel is 0 or 255: an id matte or a stencil, whose edge pixels show
/// a mix of surfaces in the plate all the same.
[[nodiscard]] bool is_hard(ViewU8x1 matte);

/// Coverage along the inside of a hard edge, estimated from the plate: a boundary pixel's colour is
/// taken as a mix of the nearest sure inside and outside colours. Never adds coverage where the
/// matte is 0. `plate` is display-encoded 8-bit; `width_px` is how deep the mixed band may be.
[[nodiscard]] Matte soften_hard_edge(ViewU8x3 plate, ViewU8x1 matte, float width_px = 1.5f);

}  // namespace weft
