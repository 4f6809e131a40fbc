#pragma once
// The artist's hand on the surface: pins that put the texture back where it belongs.

#include <vector>

#include "engine/motion/lattice_field.h"

namespace weft {

/// On one frame, what the texture shows at `from` belongs at `to`; plate pixels. `from` == `to`
/// holds a place.
struct SurfacePin {
    Vec2 from{0, 0}, to{0, 0};
    bool operator==(const SurfacePin&) const = default;
};

/// The field bent so that every pin's `to` shows what its `from` showed: one pin moves the whole
/// texture, two turn and scale it, more bend it, each by moving least squares of similarities
/// (Schaefer, McPhail & Warren 2006, section 2.2). Exact at the pins but for the lattice's own
/// interpolation. Without pins the field itself. Pure.
[[nodiscard]] LatticeField corrected(const LatticeField& ref_from_cur,
                                     const std::vector<SurfacePin>& pins);

}  // namespace weft
