#pragma once
// What comes in front of a surface, over the picture's border or from beside it, faster than its
// boundary is followed. By its motion the surface would go on there, and nothing of the frame
// before says whose it is: an arm, a tree, a hand on a jacket that fills the picture's corner.

#include "engine/core/fields.h"
#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/mask/surface_palette.h"

namespace weft {

/// Views of the area have one size and lie at `area` in the full-size ones.
struct EntriesInput {
    ViewU8x3 frame;         ///< Display codes.
    const FlowField& flow;  ///< prev_from_cur as measured.
    ViewF1 prev_phi;        ///< Signed distance on the frame before, pixels.
    ViewF2 surface_motion;  ///< prev_from_cur of the surface, extended outwards, pixels.
    Recti area;
    const SurfacePalette& palette;
    float unit_px = 1;  ///< A pixel of 854×480.
};

/// 255 where the surface would be by its motion, but the picture shows colours of something else,
/// far more than the surface's own are around it; where that was on the frame before is not known,
/// or was outside; and it is joined to what is outside or to the picture's border. Nothing if that
/// is more than a third of the surface (a flash, a black frame). Of the area's size. Parallel over
/// rows; deterministic.
[[nodiscard]] Matte foreign_entries(const EntriesInput& in);

}  // namespace weft
