#pragma once
// Shapes that live as long as an outline keeps its topology.

#include <map>
#include <memory>
#include <vector>

#include "engine/mask/matte_outlines.h"
#include "engine/mask/roto_shape.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// A closed shape, one of those that draw a matte together: a key on each frame of its life, all
/// with as many points.
struct MatteShape {
    int level = 0;                  ///< As MatteOutline::level: odd, it is a hole.
    std::map<int, RotoShape> keys;  ///< By frame.
};

/// What a frame shows of a surface, and how the surface moves there.
struct OutlinedFrame {
    std::vector<MatteOutline> outlines;
    LatticeField from_last;       ///< From the frame before in the order of the walk; empty: first.
    LatticeField from_reference;  ///< From the frame on which the walks begin.
};

/// Follows outlines from frame to frame. `frames[reference]` is where it begins, towards both ends;
/// `from_last` of a frame before it is from the frame after. An outline goes on as a shape while
/// most of it lies within 2.5 % of the picture's diagonal (4 px or more) of where the
/// surface's motion takes it, and begins another one otherwise: where it splits, joins, opens or
/// closes. Its points go where the motion takes them from the reference frame if that is within 2
/// px of the outline (of a shape that begins there), else from the frame before, and from there to
/// the nearest place of the outline, in order. Shapes begin on the outlines' order; their keys
/// count `frames` from 0. Pure and thread-safe.
[[nodiscard]] std::vector<MatteShape> matte_shapes(const std::vector<OutlinedFrame>& frames,
                                                   std::size_t reference, Size picture);

}  // namespace weft
