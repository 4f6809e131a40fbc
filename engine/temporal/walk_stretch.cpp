// What a walk does with a texture that is drawn out too far.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/temporal/stretch_limit.h"
#include "engine/temporal/walk_state.h"

namespace weft {
namespace {

LatticeField difference(const LatticeField& a, const LatticeField& b) {
    LatticeField out = a;
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i)
            out.set_node(i, j, a.node(i, j) - b.node(i, j));
    }
    return out;
}

// A frame's position, after the texture has slid by `slid` on another one.
void slide(LatticeField& ref_from_there, const LatticeField& slid,
           const LatticeField& cur_from_there) {
    for (int j = 0; j < ref_from_there.nodes().height(); ++j) {
        for (int i = 0; i < ref_from_there.nodes().width(); ++i) {
            const Vec2 here = ref_from_there.node_position(i, j) + cur_from_there.node(i, j);
            ref_from_there.set_node(i, j, ref_from_there.node(i, j) + slid.at(here));
        }
    }
}

}  // namespace

// If much of the surface is past the stretch limit, the texture returns to its own shape at once,
// and the previous track continues beside it for a while.
bool SurfaceWalker::State::reanchor(ViewU8x1 visible) {
    if (!hide_reanchoring || hiding_left > 0) return false;
    std::optional<LatticeField> relaxed =
        relaxed_stretch(ref_from_cur, visible, scale_range(visible));
    if (!relaxed) return false;
    stretched_at_event = std::exchange(ref_from_cur, std::move(*relaxed));
    relaxed_at_event = ref_from_cur;
    stretched = stretched_at_event;
    hiding_left = kReanchorFrames;
    return true;
}

// The surface as a whole may be as much larger or smaller as what is seen of it is, and a tenth
// more. How large a part was is not known.
ScaleRange SurfaceWalker::State::scale_range(ViewU8x1 visible) const {
    if (first_px == 0) return {1.0f / 3, 3.0f};
    const auto seen = static_cast<float>(std::max<std::int64_t>(1, visible_pixels(visible)));
    const float grown = std::sqrt(static_cast<float>(first_px) / seen);
    return {std::min(1.0f, grown) / 1.1f, std::max(1.0f, grown) * 1.1f};
}

// Where the texture slides, it slides on the present anchor as well; older ones would pull it back.
// The track from before it was let go does not slide.
void SurfaceWalker::State::slide_back(ViewU8x1 visible) {
    const LatticeField before = ref_from_cur;
    if (!limit_stretch(ref_from_cur, visible, scale_range(visible))) return;
    const LatticeField slid = difference(ref_from_cur, before);
    if (hiding_left > 0) {
        const LatticeField event_from_cur = compose(before, inverse(relaxed_at_event));
        slide(relaxed_at_event, slid, inverse(event_from_cur));
    }
    Anchor kept = anchors.present();
    slide(kept.ref_from_anchor, slid, inverse(anchor_from_cur));
    anchors.clear();
    anchors.add(std::move(kept));
}

// Both tracks lie on the same surface, so the registration's correction holds for both.
void SurfaceWalker::State::advance_stretched() {
    if (hiding_left == 0 || --hiding_left == 0) {
        stretched = {};
        return;
    }
    stretched = compose(compose(ref_from_cur, inverse(relaxed_at_event)), stretched_at_event);
}

}  // namespace weft
