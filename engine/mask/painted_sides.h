#pragma once
// What has been painted on the wrong side of a matte.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// A painted frame and the frame that a walk comes to next; all of one size.
struct PaintedInput {
    ViewU8x3 frame;  ///< The painted one, display codes.
    ViewU8x1 key;    ///< What was painted on it: more than 127 is inside.
    ViewU8x3 next;
    const FlowField& frame_from_next;  ///< As measured, px.
    float unit_px;                     ///< A pixel of 854×480.
};

/// People paint around a wall, a floor or a table loosely: half of a face is in the matte, and a
/// rim of wall around a head is not. Where the painted surface moves as one plane, pieces of the
/// painted frame without an edge in them tell where their side is: a piece of the inside that moves
/// otherwise and has none of the surface's colours is something in front; a piece of the outside
/// that goes on across the painted boundary without an edge, stays on the plane, and has nothing
/// beside it but things that move otherwise, is the surface. What was painted, with those pieces on
/// their side; empty if nothing is painted on a wrong side, or the surface bends. Pure;
/// deterministic.
[[nodiscard]] Matte painted_sides(const PaintedInput& in);

}  // namespace weft
