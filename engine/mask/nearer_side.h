#pragma once
// Whose is what lies between two sides that look alike?

#include "engine/core/image.h"

namespace weft {

/// What has come to light between a surface and what surrounds it.
struct BetweenSides {
    ViewU8x3 frame;    ///< Display codes.
    ViewF1 phi;        ///< Signed distance of the surface's matte, px.
    ViewU8x1 outside;  ///< Not 0: known to be of the surroundings.
    float unit_px;     ///< A pixel of 854×480.
};

/// Kerb and pavement are both grey, so the palette of the kerb takes either. Clears the pieces of
/// `pieces` (not 0; H×W as all others) of which more than a third looks, on the average of its
/// surroundings, rather like the outside within some pixels of it than like the surface there. What
/// has neither beside it says nothing. Pure; deterministic.
void drop_nearer_outside(const BetweenSides& in, Matte& pieces);

}  // namespace weft
