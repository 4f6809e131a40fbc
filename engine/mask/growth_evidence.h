#pragma once
// What a pixel's motion and colour say about a shape that the background's clean plate would let
// grow or shrink.

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/mask/surface_palette.h"

namespace weft {

/// Input of the two functions below. Views of the area (`frame`, `expected_phi`, `surface_motion`)
/// have one size and lie at `area` in the full-size views.
struct GrowthInput {
    ViewU8x3 frame;
    ViewF1 expected_phi;
    ViewF2 surface_motion;  ///< prev_from_cur of the surface, extended outwards, pixels.
    Recti area;
    ViewU8x3 prev_frame;
    ViewF1 prev_phi;
    const FlowField* flow = nullptr;  ///< prev_from_cur as measured.
};

/// Mean difference, 8-bit levels, of each pixel's surroundings from what the surface showed there
/// in the frame before; −1 where the surface was not seen, and where the colour is more often that
/// of something else, because a leak resembles itself too. Thread-safe; parallel over rows.
[[nodiscard]] ImageF1 surface_difference(const GrowthInput& in, const SurfacePalette& palette,
                                         float reach_px);

/// Corrects the clean plate's log odds for inside, since another thing that moves differs from the
/// background too. They fall where the colour is rather that of something else, below 0 where it
/// clearly is; and to 0 where reliable motion says that the pixel was `far_px` outside. Parallel
/// over rows.
void limit_growth(ImageF1& plate_odds, const GrowthInput& in, const SurfacePalette& palette,
                  float far_px);

}  // namespace weft
