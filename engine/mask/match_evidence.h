#pragma once
// Which side a pixel was on in the frame before. Its patch is searched among the pixels that were
// inside and among those that were outside; the better match decides (the split nearest-neighbour
// idea of JumpCut, Fan et al. 2015, with motion as the only guess).

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// Input of match_evidence(). The views of the area (`frame`, `expected_phi`, both motions) have
/// one size and lie at `origin` in the full-size views.
struct MatchInput {
    ViewU8x3 frame;
    ViewF1 expected_phi;
    ViewF2 inside_motion;   ///< prev_from_cur of the surface, extended outwards, pixels.
    ViewF2 outside_motion;  ///< The same of what surrounds it, extended inwards.
    Vec2i origin{0, 0};
    ViewU8x3 prev_frame;
    ViewF1 prev_phi;
    ViewF2 flow;  ///< prev_from_cur as measured.
};

/// Log odds for inside at every pixel nearer than `band_px` to the expected boundary, 0 elsewhere
/// and where only one side is in reach. Pure; thread-safe; runs in parallel over rows.
[[nodiscard]] ImageF1 match_evidence(const MatchInput& in, float band_px);

}  // namespace weft
