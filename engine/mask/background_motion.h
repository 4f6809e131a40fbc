#pragma once
// Motion of a shape's surroundings, continued behind the shape.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// Motion (H×W×2 pixels, defined everywhere) of what lies outside the shape: one moving plane
/// fitted robustly to all of it (fit_plane()), plus local corrections near the places where they
/// were measured. `prev_phi`: the shape's signed distance (pixels) on the frame that the motion
/// leads to. Deterministic.
[[nodiscard]] ImageF2 background_motion(ViewF1 prev_phi, const FlowField& prev_from_cur,
                                        float clearance_px);

}  // namespace weft
