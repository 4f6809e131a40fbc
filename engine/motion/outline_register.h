#pragma once
// Motion of a flat surface from one drawing to the next: by its outline and its lines.

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// One frame of a region; all H×W, 8 bit.
struct OutlineView {
    ViewU8x1 luma;
    ViewU8x1 extent;   ///< The region's matte, hidden parts included: its outline is the shape's.
    ViewU8x1 visible;  ///< The same without holdouts.
};

/// prev_from_cur of a region that shows hardly more than its outline. Each frame becomes a picture
/// of the signed distance to the outline of the *extent* in a band about it, so that what passes in
/// front does not matter, and inside of that of the lines and tones drawn on what is visible. They
/// are registered from wide bands to narrow ones: by a homography, and from that and from `initial`
/// by a smooth field; the homography is kept where it explains as much, since an outline says
/// nothing of motion along itself, and a plane knows it. `initial`: raw estimate, defined
/// everywhere. Where there is nothing to register the result is `initial`. Pure; deterministic.
[[nodiscard]] LatticeField register_outline(const OutlineView& prev, const OutlineView& cur,
                                            const LatticeField& initial);

}  // namespace weft
