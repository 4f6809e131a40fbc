#pragma once
// Pins: an artist's corrections that put the texture back where it belongs.

#include <vector>

#include "engine/motion/lattice_field.h"

namespace weft {

/// On one frame, the texture that is seen at `from` belongs at `to`; plate pixels. `from` == `to`
/// fixes a place.
struct SurfacePin {
    Vec2 from{0, 0}, to{0, 0};
    bool operator==(const SurfacePin&) const = default;
};

/// The field bent so that every pin's `to` shows what its `from` showed. One pin moves the whole
/// texture, two rotate and scale it, more bend it: moving least squares of similarities (Schaefer,
/// McPhail & Warren 2006, section 2.2). Exact at the pins, except for the lattice's interpolation.
/// Without pins returns the field itself. Pure.
[[nodiscard]] LatticeField corrected(const LatticeField& ref_from_cur,
                                     const std::vector<SurfacePin>& pins);

/// A field that was corrected by the pins `before`, with the pins `after` in their place: while
/// pins are moved, nothing has to be tracked again on their frame. Exact but for the inverse of the
/// first correction. Pure.
[[nodiscard]] LatticeField recorrected(const LatticeField& ref_from_cur,
                                       const std::vector<SurfacePin>& before,
                                       const std::vector<SurfacePin>& after);

}  // namespace weft
