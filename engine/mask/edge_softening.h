#pragma once
#include "engine/core/image.h"

namespace weft {

/// How far a matte is hard, 0–1: 1 if practically every pixel is 0 or 255, as in an ID matte or a
/// stencil (edge pixels of the plate show a mix of surfaces even then), 0 for a soft outline, and
/// gradually between, so that a clip's edges do not switch from one frame to the next.
[[nodiscard]] float edge_hardness(ViewU8x1 matte);

/// Coverage along the inside of a hard edge, estimated from the plate: the colour of a boundary
/// pixel is explained as a mix of the nearest sure inside and outside colours. Never adds coverage
/// where the matte is 0. `plate`: display-encoded, 8 bit. `width_px`: how deep the mixed band may
/// be.
[[nodiscard]] Matte soften_hard_edge(ViewU8x3 plate, ViewU8x1 matte, float width_px = 1.5f);

}  // namespace weft
