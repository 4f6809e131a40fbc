#include "engine/temporal/surface_walker.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/motion/relocalise.h"
#include "engine/motion/surface_fit.h"
#include "engine/temporal/anchors.h"
#include "engine/temporal/step_motion.h"
#include "engine/temporal/stretch_limit.h"

namespace weft {
namespace {

std::int64_t count_of(ViewU8x1 visible) {
    std::int64_t count = 0;
    for (int y = 0; y < visible.height(); ++y) {
        const std::uint8_t* row = visible.row(y);
        count += std::count_if(row, row + visible.width(), [](std::uint8_t m) { return m >= 128; });
    }
    return count;
}

}  // namespace

struct SurfaceWalker::State {
    SurfaceWalkerOptions options;
    LatticeField ref_from_cur, prev_from_cur;
    std::shared_ptr<const StepFrame> last;

    AnchorSet anchors;
    LatticeField anchor_from_cur;  // of the present anchor
    // Against which outlines are registered: the last reference frame, and its position.
    std::shared_ptr<const StepFrame> drawing;
    LatticeField ref_from_drawing;
    MotionChoice choice;
    int since_older_tried = 0;  // frames

    // After the texture was released to its own shape: its previous track, continued for the
    // frames over which a seam hides the change.
    LatticeField relaxed_at_event, stretched_at_event, stretched;
    int hiding_left = 0;  // frames
    bool hide_reanchoring = false;

    bool lost = false;                     // not visible, or not found again yet
    int hidden_for = 0, searched_for = 0;  // frames
    std::int64_t largest_px = 0;           // the largest visible area in any frame
    // The last frame that showed enough of the surface to determine its motion as a whole.
    LatticeField steady_ref_from_cur, steady_step;
    int since_steady = 0;  // frames
    // Frames on which it was visible while it was searched, each with the step from the frame
    // before.
    struct Searched {
        std::shared_ptr<const StepFrame> frame;
        LatticeField prev_from_cur;
        bool a_sliver = false;
    };
    std::vector<Searched> searched;
    std::vector<LatticeField> found_late;

    void become_anchor(std::shared_ptr<const StepFrame> frame) {
        const int generation = anchors.empty() ? 0 : anchors.present().generation + 1;
        anchors.add({std::move(frame), ref_from_cur, generation});
        anchor_from_cur = LatticeField(frame_size(), options.spacing_px);
    }
    void become_drawing() {
        drawing = last;
        ref_from_drawing = ref_from_cur;
    }
    [[nodiscard]] Size frame_size() const { return last->size(); }

    // The position of the frame on an anchor, from the positions of both on the reference frame.
    [[nodiscard]] LatticeField predicted(const Anchor& anchor) const {
        return compose(ref_from_cur, inverse(anchor.ref_from_anchor));
    }
    void follow(LatticeField step) {
        prev_from_cur = std::move(step);
        anchor_from_cur = compose(prev_from_cur, anchor_from_cur);
        ref_from_cur = compose(anchor_from_cur, anchors.present().ref_from_anchor);
    }
    void correct(std::size_t anchor, LatticeField field) {
        anchors.use(anchor);
        anchor_from_cur = std::move(field);
        ref_from_cur = compose(anchor_from_cur, anchors.present().ref_from_anchor);
    }

    [[nodiscard]] bool is_hidden(std::int64_t visible_px);
    // True if too little of the surface is visible to determine its motion.
    [[nodiscard]] bool is_sliver(std::int64_t visible_px) const {
        return 6 * visible_px < largest_px;
    }
    bool reanchor(ViewU8x1 visible);
    void advance_stretched();
    void note_steady(ViewU8x1 visible, std::int64_t visible_px);
    // A frame against an anchor, by what the walk goes by.
    [[nodiscard]] Registered against(const Anchor& anchor, const StepFrame& cur,
                                     const LatticeField& initial) const {
        return register_against(anchor, cur, choice.by_color(), initial, options.quality);
    }
    void find_late(const std::shared_ptr<const StepFrame>& cur);
    void wait_out_of_view();
    void search(const std::shared_ptr<const StepFrame>& cur, std::int64_t visible_px);
    void register_frame(const std::shared_ptr<const StepFrame>& cur);
    void register_drawing(const StepFrame& cur);
    bool try_others(const StepFrame& cur, int generation_below, double share_above);
};

bool SurfaceWalker::State::is_hidden(std::int64_t visible_px) {
    largest_px = std::max(largest_px, visible_px);
    // A narrow strip does not determine the motion of the whole.
    return visible_px < std::max<std::int64_t>(64, largest_px / 100);
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
    const Anchor here{cur, ref_from_cur, 0};
    const bool here_too = is_sliver(count_of(visible)) && !steady_step.nodes().empty();
    const LatticeField usual =
        inverse(here_too ? steady_step : similar_motion(prev_from_cur, visible));
    LatticeField here_from_frame(frame_size(), options.spacing_px);
    LatticeField step = prev_from_cur;
    for (std::size_t k = searched.size(); k-- > 0;) {
        here_from_frame = compose(searched[k].a_sliver ? usual : inverse(step), here_from_frame);
        Registered found = against(here, *searched[k].frame, here_from_frame);
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
        if (accept(k, against(all[k], *cur, predicted(all[k])))) return;
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto start =
            find_again(all[k].frame->picture(), cur->picture(), frame_size(), options.spacing_px);
        if (start && accept(k, against(all[k], *cur, *start))) return;
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

// Switches to another anchor of an earlier generation if one explains the frame. Only generations
// below `generation_below`; the share must exceed `share_above`.
bool SurfaceWalker::State::try_others(const StepFrame& cur, int generation_below,
                                      double share_above) {
    const auto& all = anchors.all();
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (k == anchors.present_index() || all[k].generation >= generation_below) continue;
        const Registered found = against(all[k], cur, predicted(all[k]));
        if (!found.holds() || found.fit.share < share_above) continue;
        correct(k, found.anchor_from_cur);
        return true;
    }
    return false;
}

// If much of the surface is past the stretch limit, the texture returns to its own shape at once,
// and the previous track continues beside it for a while.
bool SurfaceWalker::State::reanchor(ViewU8x1 visible) {
    if (!hide_reanchoring || hiding_left > 0) return false;
    std::optional<LatticeField> relaxed = relaxed_stretch(ref_from_cur, visible);
    if (!relaxed) return false;
    stretched_at_event = std::exchange(ref_from_cur, std::move(*relaxed));
    relaxed_at_event = ref_from_cur;
    stretched = stretched_at_event;
    hiding_left = kReanchorFrames;
    return true;
}

// Both tracks lie on the same surface, so the registration's correction holds for both.
void SurfaceWalker::State::advance_stretched() {
    if (hiding_left == 0 || --hiding_left == 0) {
        stretched = {};
        return;
    }
    stretched = compose(compose(ref_from_cur, inverse(relaxed_at_event)), stretched_at_event);
}

void SurfaceWalker::State::register_frame(const std::shared_ptr<const StepFrame>& cur) {
    const ViewU8x1 visible = cur->view().visible;
    const Registered found = against(anchors.present(), *cur, anchor_from_cur);
    // The chain is steady but drifts; the registration does not drift but jitters. The gains are
    // those of stationary Kalman filters that combine them.
    constexpr float kPlanarGain = 0.85f, kSmoothGain = 0.7f;
    correct(anchors.present_index(),
            mix(anchor_from_cur, found.anchor_from_cur, found.planar ? kPlanarGain : kSmoothGain));
    if (reanchor(visible) || limit_stretch(ref_from_cur, visible)) {
        // The texture slid: older anchors would pull it back.
        anchors.clear();
        become_anchor(cur);
        return;
    }
    constexpr double kEnough = 0.6;
    if (found.fit.share < kEnough) {
        if (!try_others(*cur, anchors.present().generation + 1, kEnough)) become_anchor(cur);
        return;
    }
    // An older anchor has less drift, so it is used again when the view returns to it.
    constexpr int kEvery = 6;
    if (anchors.present().generation > 0 && ++since_older_tried >= kEvery) {
        since_older_tried = 0;
        try_others(*cur, anchors.present().generation, kEnough);
    }
}

// What shows little but its outline is laid on the outline of the reference frame, where corners
// come to lie on corners. A thing that turned away from it has no such motion: cars lose and gain
// parts of their outline.
void SurfaceWalker::State::register_drawing(const StepFrame& cur) {
    constexpr double kLost = 0.075;
    constexpr float kGain = 0.5f;
    const OutlineShape &there = drawing->outline(), &here = cur.outline();
    const LatticeField chain = compose(ref_from_cur, inverse(ref_from_drawing));
    if (outline_slip(there.curve(), here.curve(), chain) > kLost) return;
    const LatticeField found = register_outline(there, here, options.spacing_px);
    if (outline_slip(there.curve(), here.curve(), found) > kSlipping) return;
    ref_from_cur = compose(mix(chain, found, kGain), ref_from_drawing);
    anchor_from_cur = predicted(anchors.present());
}

SurfaceWalker::SurfaceWalker(std::shared_ptr<const StepFrame> start,
                             const SurfaceWalkerOptions& options,
                             const LatticeField* ref_from_start)
    : state_(std::make_unique<State>()) {
    const LatticeField still(start->size(), options.spacing_px);
    state_->options = options;
    state_->ref_from_cur = ref_from_start ? *ref_from_start : still;
    state_->prev_from_cur = still;
    state_->last = std::move(start);
    state_->become_anchor(state_->last);
    state_->become_drawing();
}

SurfaceWalker::SurfaceWalker(ViewU8x1 luma, ViewU8x1 visible, const SurfaceWalkerOptions& options,
                             const LatticeField* ref_from_start, ViewU8x1 extent)
    : SurfaceWalker(
          std::make_shared<const StepFrame>(luma, visible, extent.empty() ? visible : extent),
          options, ref_from_start) {}

SurfaceWalker::SurfaceWalker(const SurfaceWalker& other)
    : state_(std::make_unique<State>(*other.state_)) {}
SurfaceWalker::~SurfaceWalker() = default;
SurfaceWalker::SurfaceWalker(SurfaceWalker&&) noexcept = default;
SurfaceWalker& SurfaceWalker::operator=(SurfaceWalker&&) noexcept = default;

const LatticeField& SurfaceWalker::advance(ViewU8x1 luma, ViewU8x1 visible,
                                           const FlowField& prev_from_cur, ViewU8x1 extent) {
    State& s = *state_;
    auto cur = std::make_shared<const StepFrame>(luma, visible, extent.empty() ? visible : extent);
    StepEvidence evidence = s.options.exact_motion
                                ? exact_evidence(*cur, prev_from_cur, s.options.spacing_px)
                                : gather_evidence(*s.last, *cur, prev_from_cur, s.options.quality,
                                                  s.options.spacing_px);
    return advance({std::move(cur), std::move(evidence)});
}

const LatticeField& SurfaceWalker::advance(const WalkStep& to) {
    State& s = *state_;
    const StepFrame& cur = *to.frame;
    const ViewU8x1 visible = cur.view().visible;
    const auto keep = [&]() -> const LatticeField& {
        s.last = to.frame;
        return s.ref_from_cur;
    };
    if (s.options.exact_motion) {
        s.follow(to.evidence.by_picture);
        return keep();
    }
    const bool hiding = s.hiding_left > 0;
    const std::int64_t visible_px = count_of(visible);
    const bool was_hidden = s.hidden_for > 0 && s.searched_for == 0;
    if (s.is_hidden(visible_px)) {
        s.wait_out_of_view();
        if (hiding) s.advance_stretched();
        return keep();
    }
    const auto noted = [&]() -> const LatticeField& {
        s.note_steady(visible, visible_px);
        if (hiding) s.advance_stretched();
        return keep();
    };
    // A part that has just come into view has no motion yet, and says nothing for either choice.
    MotionChoice unchanged = s.choice;
    StepMotion step = choose_motion(to.evidence, was_hidden ? unchanged : s.choice);
    s.follow(was_hidden ? s.prev_from_cur : std::move(step.prev_from_cur));
    if (step.by_outline) {
        s.register_drawing(cur);
    } else if (s.lost) {
        s.search(to.frame, visible_px);
    } else {
        s.register_frame(to.frame);
    }
    return noted();
}

const LatticeField* SurfaceWalker::stretched() const {
    return state_->stretched.nodes().empty() ? nullptr : &state_->stretched;
}
void SurfaceWalker::hide_reanchoring(bool hide) {
    state_->hide_reanchoring = hide;
}

std::vector<LatticeField> SurfaceWalker::take_found_late() {
    return std::exchange(state_->found_late, {});
}

void SurfaceWalker::advance_known(ViewU8x1 luma, ViewU8x1 visible, LatticeField prev_from_cur,
                                  LatticeField anchor_from_cur) {
    State& s = *state_;
    s.prev_from_cur = std::move(prev_from_cur);
    s.correct(s.anchors.present_index(), std::move(anchor_from_cur));
    s.last = std::make_shared<StepFrame>(luma, visible, visible);
}

void SurfaceWalker::hold() {
    state_->prev_from_cur = LatticeField(state_->frame_size(), state_->options.spacing_px);
}

void SurfaceWalker::anchor_here(const LatticeField* ref_from_here) {
    state_->lost = false;
    state_->hidden_for = 0;
    state_->searched.clear();
    if (ref_from_here) {
        state_->ref_from_cur = *ref_from_here;
        // Older anchors would pull it back.
        state_->anchors.clear();
    }
    state_->become_anchor(state_->last);
    state_->become_drawing();
}

const LatticeField& SurfaceWalker::ref_from_cur() const {
    return state_->ref_from_cur;
}
const LatticeField& SurfaceWalker::prev_from_cur() const {
    return state_->prev_from_cur;
}

}  // namespace weft
