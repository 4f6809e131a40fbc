#pragma once

#include "engine/core/fields.h"
#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// A step of the walk whose boundary is found. Views have the frame's size but `surface_motion`,
/// which has that of `area`.
struct GroundStep {
    ViewU8x3 frame, prev_frame;  ///< Display codes.
    const FlowField& flow;       ///< prev_from_cur as measured.
    const Matte& parting;        ///< parting_pixels() of it and the whole frame.
    ViewF2 surface_motion;       ///< prev_from_cur of the surface, px.
    Recti area;                  ///< Where the surface may be; empty once it has left the frame.
    ViewF1 prev_phi, phi;   ///< Signed distance of the matte on the frame before and on this one.
    float unit_px = 1;      ///< A pixel of a frame 854 wide.
    ViewU8x1 dropped = {};  ///< Not 0: was just taken out, as never the surface's; may be empty.
};

}  // namespace weft
