#pragma once
// Motion of a flat surface from one drawing to the next, from its outline and its lines.

#include "engine/motion/lattice_field.h"
#include "engine/motion/outline_shape.h"

namespace weft {

/// prev_from_cur of a region that shows little more than its outline. Each frame becomes a picture
/// of the signed distance to the outline of the *full matte* in a band about it, so that holdouts
/// have no effect, and, inside, of the visible lines and tones. The pictures are registered from
/// wide bands to narrow ones: by a homography, and by a smooth field that starts from it and from
/// `initial`. The homography is kept where it explains as much, because an outline does not
/// determine motion along itself and a plane does. `initial`: raw estimate (pixels), defined
/// everywhere; it is the result where there is nothing to register. Deterministic.
[[nodiscard]] LatticeField register_outline(const OutlineShape& prev, const OutlineShape& cur,
                                            const LatticeField& initial);
/// The same without an estimate to begin with, on a lattice of `spacing_px`.
[[nodiscard]] LatticeField register_outline(const OutlineShape& prev, const OutlineShape& cur,
                                            int spacing_px);

}  // namespace weft
