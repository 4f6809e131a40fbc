#pragma once
// Which pixels belong to the parts that move by themselves.

#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"
#include "engine/motion/moving_parts.h"
#include "engine/temporal/step_motion.h"

namespace weft {

struct PartOutline {
    Matte matte;          ///< H×W, 0 or 255.
    LatticeField motion;  ///< Its own, prev_from_cur.
};

struct PartOutlines {
    std::vector<PartOutline> parts;  ///< In the order of MovingParts; no pixel is of two.
    LatticeField body_motion;        ///< prev_from_cur of the rest.
};

/// The outlines of `parts` on `cur`, within what is visible of it. Cells say what surely belongs to
/// a part; each other pixel goes by which motion finds its colours again on `prev`, the part's or
/// any other, and by whose colours it has, as a minimum cut along the picture's edges
/// (cut_band()). What the body shows anew, where the part was, nobody's motion finds: that counts
/// for the body, which is behind. Both frames need their display. Pure; deterministic.
[[nodiscard]] PartOutlines part_outlines(const StepFrame& prev, const StepFrame& cur,
                                         const FlowField& prev_from_cur, const MovingParts& parts,
                                         int spacing_px);

}  // namespace weft
