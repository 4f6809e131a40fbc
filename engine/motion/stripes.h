#pragma once
// Surfaces whose picture says how they move across its lines, and nothing of how along them.

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

struct Stripes {
    Vec2 along{0, 1};  ///< Their direction, a unit vector.
    /// 0 where the picture has structure in two directions, 1 where it has lines of one alone.
    float share = 0;
};

/// Of the region's slopes of luma as a whole (the structure tensor, Bigün & Granlund 1987): the
/// lines' direction, and by its smaller eigenvalue over the larger one how far there is no other;
/// in full below 0.06, not at all above 0.12. Luma 8 bit, `visible` as a matte, H×W. Pure;
/// deterministic.
[[nodiscard]] Stripes stripes_of(ViewU8x1 luma, ViewU8x1 visible);

/// `field` with the motion along the stripes taken from that of the region's outline, as far as
/// `stripes` says: what `outline` has where the edge of `extent` (H×W, the frame's border is none)
/// runs across them, as a plane over the region that leans little where few places say so. `field`
/// itself if there is no such edge. Of one lattice. Pure; deterministic.
[[nodiscard]] LatticeField along_stripes(const LatticeField& field, const LatticeField& outline,
                                         ViewU8x1 extent, const Stripes& stripes);

}  // namespace weft
