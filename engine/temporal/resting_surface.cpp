#include "engine/temporal/resting_surface.h"

#include <utility>

#include "engine/motion/photometric_register.h"
#include "engine/motion/resting_view.h"
#include "engine/temporal/walk_state.h"

namespace weft {

std::optional<Vec2> rests_where_seen(const StepFrame& anchor, const StepFrame& cur) {
    const OutlineView there = anchor.view(), here = cur.view();
    return rests_in_view(there.luma, here.luma, here.visible);
}

bool clearly_moves(const StepFrame& prev, const StepFrame& cur, const LatticeField& prev_from_cur) {
    // In correlation. Shades and reflections of what passes over a blank table gain up to 0.13.
    constexpr double kMuch = 0.25;
    const LatticeField still(cur.size(), prev_from_cur.spacing());
    return registration_lead(prev.picture(), cur.picture(), prev_from_cur, still).gain > kMuch;
}

// Leaves a faint surface where the present anchor shows it, if it rests there.
bool SurfaceWalker::State::take_rest(const WalkStep& to) {
    const StepFrame& cur = *to.frame;
    if (!to.evidence.faint || lost) return false;
    const auto shift = rests_where_seen(*anchors.present().frame, cur);
    if (!shift || clearly_moves(*last, cur, to.evidence.by_picture)) return false;
    const LatticeField before = inverse(anchor_from_cur);
    LatticeField here(frame_size(), options.spacing_px);
    for (int j = 0; j < here.nodes().height(); ++j)
        for (int i = 0; i < here.nodes().width(); ++i)
            here.set_node(i, j, *shift);
    prev_from_cur = compose(here, before);
    correct(anchors.present_index(), std::move(here));
    return true;
}

}  // namespace weft
