#include "engine/temporal/resting_surface.h"

#include "engine/motion/photometric_register.h"
#include "engine/motion/resting_view.h"

namespace weft {

bool rests_where_seen(const StepFrame& anchor, const StepFrame& cur) {
    const OutlineView there = anchor.view(), here = cur.view();
    return rests_in_view(there.luma, here.luma, here.visible);
}

bool clearly_moves(const StepFrame& prev, const StepFrame& cur, const LatticeField& prev_from_cur) {
    // In correlation. Shades and reflections of what passes over a blank table gain up to 0.13.
    constexpr double kMuch = 0.25;
    const LatticeField still(cur.size(), prev_from_cur.spacing());
    return registration_lead(prev.picture(), cur.picture(), prev_from_cur, still).gain > kMuch;
}

}  // namespace weft
