#pragma once
// How what surrounds a shape moves, continued behind it.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// Motion (H×W×2 pixels, defined everywhere) of what lies outside of the shape: one moving plane
/// (8 parameters, Longuet-Higgins & Prazdny 1980) fitted robustly to all of it, and local
/// corrections near the places they were seen at. `prev_phi`: the shape's signed distance on
/// the frame that the motion leads to. Deterministic.
[[nodiscard]] ImageF2 background_motion(ViewF1 prev_phi, const FlowField& prev_from_cur,
                                        float clearance_px);

}  // namespace weft
