#pragma once
// Whether a region ends by itself, or because something passes in front of it.

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Of a region's outline, the share that moves with what lies outside and not with what lies
/// inside: there the outline is that of an occluder, and says nothing of the region's own motion
/// (the occluded side of a moving edge; Thompson, Mutch & Berzins 1985). Only where there is
/// structure outside; 0 where in and out move alike. `luma`, `extent`: H×W. Motions are
/// prev_from_cur, px: `outline` that of the outline, `inside` of the picture inside, `raw` of the
/// plate. `unseen`: a unit vector along which the picture inside does not tell its motion; edges
/// that face that way count for nothing; (0, 0): none. Pure; deterministic.
[[nodiscard]] double occluded_share(ViewU8x1 luma, ViewU8x1 extent, const LatticeField& outline,
                                    const LatticeField& inside, const FlowField& raw,
                                    Vec2 unseen = Vec2(0));

}  // namespace weft
