// A walk while its surface is hidden, out of view, or not found again yet.
#include <algorithm>
#include <utility>

#include "engine/motion/relocalise.h"
#include "engine/temporal/stretch_limit.h"
#include "engine/temporal/walk_state.h"

namespace weft {

std::int64_t visible_pixels(ViewU8x1 visible) {
    std::int64_t count = 0;
    for (int y = 0; y < visible.height(); ++y) {
        const std::uint8_t* row = visible.row(y);
        count += std::count_if(row, row + visible.width(), [](std::uint8_t m) { return m >= 128; });
    }
    return count;
}

bool SurfaceWalker::State::is_hidden(std::int64_t visible_px) {
    largest_px = std::max(largest_px, visible_px);
    // A narrow strip does not determine the motion of the whole. A tiny surface is followed by
    // less.
    return visible_px < std::max(std::min<std::int64_t>(64, largest_px / 4), largest_px / 100);
}

// A sliver's own motion is not reliable when it is extrapolated over the whole surface and many
// frames. Behind an occluder the surface therefore follows a similarity of its last reliable
// motion.
void SurfaceWalker::State::note_steady(ViewU8x1 visible, std::int64_t visible_px) {
    ++since_steady;
    if (lost || 3 * visible_px < largest_px) return;
    steady_ref_from_cur = ref_from_cur;
    steady_step = similar_motion(prev_from_cur, visible);
    since_steady = 0;
}

// The surface continues its last motion, for a limited time.
void SurfaceWalker::State::wait_out_of_view() {
    constexpr int kLongest = 24;
    searched_for = 0;
    searched.clear();
    const bool still = ++hidden_for > kLongest;
    if (still || steady_step.nodes().empty()) {
        follow(still ? LatticeField(frame_size(), options.spacing_px) : prev_from_cur);
    } else {
        if (!lost) {
            ref_from_cur = steady_ref_from_cur;
            for (int k = 0; k < since_steady; ++k)
                ref_from_cur = compose(steady_step, ref_from_cur);
            anchor_from_cur = predicted(anchors.present());
        }
        follow(steady_step);
    }
    lost = true;
}

// The frames between the surface's return and its detection: backwards from here along the measured
// steps, each registered against this frame. A sliver is assumed to move as the whole does.
void SurfaceWalker::State::find_late(const std::shared_ptr<const StepFrame>& cur) {
    const ViewU8x1 visible = cur->view().visible;
    const Anchor here{cur, ref_from_cur, 0, prev_from_cur};
    const bool here_too = is_sliver(visible_pixels(visible)) && !steady_step.nodes().empty();
    const LatticeField usual =
        inverse(here_too ? steady_step : similar_motion(prev_from_cur, visible));
    LatticeField here_from_frame(frame_size(), options.spacing_px);
    LatticeField step = prev_from_cur;
    for (std::size_t k = searched.size(); k-- > 0;) {
        here_from_frame = compose(searched[k].a_sliver ? usual : inverse(step), here_from_frame);
        Registered found =
            against(here, *searched[k].frame, searched[k].prev_from_cur, here_from_frame);
        if (found.holds()) here_from_frame = std::move(found.anchor_from_cur);
        found_late.push_back(compose(here_from_frame, ref_from_cur));
        step = std::move(searched[k].prev_from_cur);
    }
    searched.clear();
}

// The surface is in view again, near its predicted position or anywhere else.
void SurfaceWalker::State::search(const std::shared_ptr<const StepFrame>& cur,
                                  std::int64_t visible_px) {
    const auto accept = [&](std::size_t k, const Registered& found) {
        if (!found.holds()) return false;
        correct(k, found.anchor_from_cur);
        lost = false;
        hidden_for = 0;
        find_late(cur);
        return true;
    };
    const auto& all = anchors.all();
    for (std::size_t k = all.size(); k-- > 0;) {
        if (accept(k, against(all[k], *cur, prev_from_cur, predicted(all[k])))) return;
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto start =
            find_again(all[k].frame->picture(), cur->picture(), frame_size(), options.spacing_px);
        if (start && accept(k, against(all[k], *cur, prev_from_cur, *start))) return;
    }
    // Enough of it has been visible for long enough: its appearance has changed.
    constexpr int kLongest = 10;
    constexpr std::size_t kMostKept = 32;
    if (++searched_for > kLongest && 2 * visible_px > largest_px) {
        lost = false;
        hidden_for = 0;
        searched.clear();
        become_anchor(cur);
        return;
    }
    if (searched.size() == kMostKept) searched.erase(searched.begin());
    searched.push_back({cur, prev_from_cur, is_sliver(visible_px)});
}

}  // namespace weft
