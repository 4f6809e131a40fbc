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
        relaxed_stretch(ref_from_cur, visible, stretch_limits(visible));
    if (!relaxed) return false;
    stretched_at_event = std::exchange(ref_from_cur, std::move(*relaxed));
    relaxed_at_event = ref_from_cur;
    stretched = stretched_at_event;
    // The previous track is stretched further on each frame, and worse where nothing holds it.
    constexpr int kInDoubt = 4;
    hiding_frames = static_cast<int>(
        std::lround(kReanchorFrames + doubt.share() * (kInDoubt - kReanchorFrames)));
    hiding_left = hiding_frames;
    return true;
}

// The surface as a whole may be as much larger or smaller as what is seen of it is, and a tenth
// more. How large a part was is not known. What the picture does not hold has no way to be
// foreshortened that could be believed.
StretchLimits SurfaceWalker::State::stretch_limits(ViewU8x1 visible) const {
    StretchLimits followed{.whole = {1.0f / 3, 3.0f}};
    if (first_px > 0) {
        const auto seen = static_cast<float>(std::max<std::int64_t>(1, visible_pixels(visible)));
        const float grown = std::sqrt(static_cast<float>(first_px) / seen);
        followed.whole = {std::min(1.0f, grown) / 1.1f, std::max(1.0f, grown) * 1.1f};
    }
    return followed.towards({2.0f, 1.5f, 1.3f, 1.1f, followed.whole}, doubt.share());
}

// What the picture does not hold as a whole goes as the similarity of what was measured; where it
// is held poorly, pieces of it turn and shift, and hardly stretch.
LatticeField SurfaceWalker::State::believed_step(const LatticeField& measured,
                                                 ViewU8x1 visible) const {
    if (plane.believed()) return measured;
    if (lost) return similar_motion(measured, visible);
    LatticeField out = measured;
    if (doubt.share() > 0) {
        const StretchLimits followed{.whole = {0.8f, 1.25f}};
        limit_stretch(out, visible,
                      followed.towards({1.15f, 1.07f, 1, 1, followed.whole}, doubt.share()));
    }
    return out;
}

// Where the texture slides, it slides on the present anchor as well; older ones would pull it back.
// The track from before it was let go does not slide.
void SurfaceWalker::State::slide_back(ViewU8x1 visible) {
    const LatticeField before = ref_from_cur;
    if (!limit_stretch(ref_from_cur, visible, stretch_limits(visible))) return;
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
