#pragma once
// Frames as a longer exposure would show them, so that a still and a moving one can be compared.

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// A frame's luma, and the matte of where it shows nothing but the surface.
struct ExposedFrame {
    Matte luma, visible;
};

/// What `luma` becomes if the surface moves by `motion` (px, of the same frame size) while the
/// shutter is open: at each pixel of `visible` (128 and above) the mean along that way, half of it
/// before and half of it behind the pixel. 0 in the result's matte where the way leaves `visible`;
/// outside of it the luma stays. All H×W, 8 bit. Pure; deterministic.
[[nodiscard]] ExposedFrame exposed_along(ViewU8x1 luma, ViewU8x1 visible,
                                         const LatticeField& motion);

/// A frame's motion as another frame of the surface shows it: `motion` belongs to the places of
/// `there`; the result to those of `here`. Both maps lead from one to the other. Pure.
[[nodiscard]] LatticeField motion_seen_from(const LatticeField& motion,
                                            const LatticeField& there_from_here,
                                            const LatticeField& here_from_there);

}  // namespace weft
