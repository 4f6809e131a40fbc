#pragma once
// Raw motion of one surface from pictures that are freed of its light.

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/motion/optical_flow.h"
#include "engine/motion/photometric_register.h"

namespace weft {

/// One frame of a surface as its raw motion is estimated from. All of one frame size.
struct SurfaceView {
    const RegistrationPicture& picture;  ///< Of the frame.
    ViewU8x1 visible;                    ///< The matte that it was made from, H×W.
};

/// prev_from_cur inside the surface's box, with its consistency (check_consistency()); not valid
/// outside of it. Dense inverse search on what registration compares: the luma less its local mean
/// and over its local deviation, inside the region only. Shade that moves over a surface, and
/// folds that travel through it, move most of the luma and little of this (after Hilsmann & Eisert
/// 2009, who estimate the shading with the motion). `frame`: H×W. Pure; deterministic.
[[nodiscard]] FlowField estimate_surface_flow(const SurfaceView& cur, const SurfaceView& prev,
                                              Size frame, FlowQuality quality);

}  // namespace weft
