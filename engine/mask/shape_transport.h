#pragma once
// Where a shape is expected in the next frame: its signed distance moved along the motion of its
// own surface, taken from inside it, so that the motion of what lies behind does not tear its edge.

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/mask/boundary_refiner.h"

namespace weft {

struct TransportedShape {
    ImageF1 phi;             ///< Expected signed distance, pixels, at the area's size.
    ImageF2 prev_from_cur;   ///< The surface's motion, extended outwards, pixels.
    ImageF2 outside_motion;  ///< The same of what surrounds the surface, extended inwards.
    float consistency = 1;   ///< Share of the boundary's surroundings whose motion can be trusted.
};

/// Bounds of the pixels whose motion leads inside the shape; empty when there are none.
[[nodiscard]] Recti transported_bounds(ViewF1 prev_phi, const FlowField& prev_from_cur);

/// `prev_phi` and `prev_from_cur` are of the frame's size, `area` lies in it.
[[nodiscard]] TransportedShape transport_shape(ViewF1 prev_phi, const FlowField& prev_from_cur,
                                               const Recti& area, const RefineScale& scale);

}  // namespace weft
