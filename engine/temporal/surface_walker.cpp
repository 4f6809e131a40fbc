#include "engine/temporal/surface_walker.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/motion/flat_motion.h"
#include "engine/temporal/outline_evidence.h"
#include "engine/temporal/tiny_surface.h"
#include "engine/temporal/walk_state.h"

namespace weft {
namespace {

// The chain is steady but drifts; the registration does not drift but jitters. The gains are those
// of stationary Kalman filters that combine them.
constexpr float kPlanarGain = 0.85f, kSmoothGain = 0.7f;

}  // namespace

// Switches to another anchor of an earlier generation if one explains the frame. Only generations
// below `generation_below`; the share must exceed `share_above`.
bool SurfaceWalker::State::try_others(const StepFrame& cur, int generation_below,
                                      double share_above) {
    const auto& all = anchors.all();
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (k == anchors.present_index() || all[k].generation >= generation_below) continue;
        const Registered found = against(all[k], cur, prev_from_cur, predicted(all[k]));
        if (!found.holds() || found.fit.share < share_above) continue;
        correct(k, plane.believed() ? flattened(found.anchor_from_cur, cur.view().visible)
                                    : found.anchor_from_cur);
        return true;
    }
    return false;
}

Registered SurfaceWalker::State::against(const Anchor& anchor, const StepFrame& cur,
                                         const LatticeField& motion,
                                         const LatticeField& initial) const {
    if (is_tiny(cur) && is_tiny(*anchor.frame)) return register_tiny(anchor, cur, initial);
    Registered found = register_against(anchor, cur, choice.by_color(), initial, options.quality);
    if (choice.by_color()) return found;
    auto alike = exposure.registered(anchor, cur, motion, initial, found, options.quality);
    return alike ? std::move(*alike) : std::move(found);
}

// How well the step explains the frame says how noisy the frames are.
void SurfaceWalker::State::note_step(const StepFrame& cur) {
    RegistrationOptions few;
    few.samples = 20000;
    const bool colors = choice.by_color() && last->has_color() && cur.has_color();
    lost_places.note(registration_fit(colors ? last->color_picture() : last->picture(),
                                      colors ? cur.color_picture() : cur.picture(), prev_from_cur,
                                      few));
}

// Against the present anchor, with all that can be learnt from it.
Registered SurfaceWalker::State::against_present(const StepFrame& cur) {
    const Anchor& anchor = anchors.present();
    if (is_tiny(cur) && is_tiny(*anchor.frame)) return register_tiny(anchor, cur, anchor_from_cur);
    note_step(cur);
    if (!choice.by_color()) exposure.learn(anchor, cur, prev_from_cur, anchor_from_cur);
    Registered found = against(anchor, cur, prev_from_cur, anchor_from_cur);
    auto wider =
        lost_places.find(anchor, cur, {choice.by_color(), choice.freed()}, found, options.quality);
    return wider ? std::move(*wider) : std::move(found);
}

// Takes the frame as a plane's if the surface is one.
std::optional<RegistrationFit> SurfaceWalker::State::lay_as_plane(const StepFrame& cur,
                                                                  const Registered& found) {
    if (!plane.believed()) return std::nullopt;
    const ViewU8x1 visible = cur.view().visible;
    const LatticeField expected = flattened(anchor_from_cur, visible);
    const auto laid = plane.registered(anchors.present(), cur, choice.by_color(), expected, found,
                                       options.quality);
    if (!plane.believed()) leave_plane(cur);
    if (!laid) return std::nullopt;
    lay(expected, laid->anchor_from_cur, visible);
    return laid->fit;
}

// The same without asking first what bends, where it need not be asked.
std::optional<RegistrationFit> SurfaceWalker::State::lay_as_settled_plane(const StepFrame& cur) {
    if (is_tiny(cur) || exposure.open_share() > 0 || !plane.may_be_taken_for_granted())
        return std::nullopt;
    const ViewU8x1 visible = cur.view().visible;
    const LatticeField expected = flattened(anchor_from_cur, visible);
    const auto laid = plane.taken_for_granted(anchors.present(), cur, choice.by_color(), expected,
                                              options.quality);
    if (!laid) return std::nullopt;
    note_step(cur);
    lay(expected, laid->anchor_from_cur, visible);
    return laid->fit;
}

// Where a plane was seen it was right; beyond its horizon it never was.
void SurfaceWalker::State::leave_plane(const StepFrame& cur) {
    plane.refute();
    anchors.each([](Anchor& anchor) {
        anchor.ref_from_anchor =
            tame_out_of_sight(anchor.ref_from_anchor, anchor.frame->view().visible);
    });
    correct(anchors.present_index(), tame_out_of_sight(anchor_from_cur, cur.view().visible));
}

void SurfaceWalker::State::lay(const LatticeField& expected, const LatticeField& registered,
                               ViewU8x1 visible) {
    correct(anchors.present_index(), flattened(mix(expected, registered, kPlanarGain), visible));
    prev_from_cur = flattened(prev_from_cur, visible);
}

void SurfaceWalker::State::register_frame(const std::shared_ptr<const StepFrame>& cur) {
    const ViewU8x1 visible = cur->view().visible;
    Registered found;
    // A plane that turns away is foreshortened, not stretched.
    std::optional<RegistrationFit> as_plane = lay_as_settled_plane(*cur);
    if (!as_plane) {
        found = against_present(*cur);
        as_plane = lay_as_plane(*cur, found);
    }
    if (as_plane) {
        found.fit = *as_plane;
    } else {
        correct(anchors.present_index(), mix(anchor_from_cur, found.anchor_from_cur,
                                             found.planar ? kPlanarGain : kSmoothGain));
        doubt.note(found.fit);
        if (reanchor(visible)) {
            // The texture has slid: older anchors would pull it back.
            anchors.clear();
            become_anchor(cur);
            return;
        }
        slide_back(visible);
    }
    constexpr double kEnough = 0.6;
    if (found.fit.share < kEnough) {
        if (try_others(*cur, anchors.present().generation + 1, kEnough)) return;
        doubt.note_replaced();
        become_anchor(cur);
        return;
    }
    // An older anchor has less drift, so it is used again when the view returns to it.
    constexpr int kEvery = 6;
    if (anchors.present().generation > 0 && ++since_older_tried >= kEvery) {
        since_older_tried = 0;
        try_others(*cur, anchors.present().generation, kEnough);
    }
}

// What the walk goes by. The outline of what was borne out as a plane is not asked: its picture
// binds it.
const StepEvidence& SurfaceWalker::State::evidence_of(const WalkStep& to) const {
    return to.evidence.open && asks_outline() ? to.evidence.open->whole() : to.evidence;
}

bool SurfaceWalker::State::may_have_parts() const {
    switch (options.kind) {
        case SurfaceKind::kBody:
            return true;
        case SurfaceKind::kFound:
            return !plane.is_settled();
        case SurfaceKind::kPlane:
        case SurfaceKind::kRigid:
        case SurfaceKind::kCloth:
            break;
    }
    return false;
}

// Takes the step if the surface has parts that move by themselves.
bool SurfaceWalker::State::advance_parts(const SurfaceWalker& whole, const WalkStep& to) {
    if (is_part || lost || !to.evidence.raw || !may_have_parts()) return false;
    if (!parts.any()) {
        parts.look(whole, last, to, options);
        if (!parts.any()) return false;
        plane.refute();
        stretched = {};
        hiding_left = 0;
    }
    parts.advance(to, options);
    last = to.frame;
    ref_from_cur = parts.ref_from_cur();
    prev_from_cur = parts.prev_from_cur();
    return true;
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
    state_->plane = RigidPlane(options.kind);
    state_->ref_from_cur = ref_from_start ? *ref_from_start : still;
    state_->last = std::move(start);
    state_->first_px = visible_pixels(state_->last->view().visible);
    state_->become_anchor(state_->last);
    state_->become_drawing();
    state_->prev_from_cur = still;
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
    if (!s.options.exact_motion) evidence.raw = std::make_shared<const FlowField>(prev_from_cur);
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
    if (s.advance_parts(*this, to)) return s.ref_from_cur;
    const bool hiding = s.hiding_left > 0;
    const std::int64_t visible_px = visible_pixels(visible);
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
    if (!was_hidden && s.take_rest(to)) return noted();
    // A part that has just come into view has no motion yet, and says nothing for either choice.
    MotionChoice unchanged = s.choice;
    const StepEvidence& evidence = s.evidence_of(to);
    StepMotion step = choose_motion(evidence, was_hidden ? unchanged : s.choice);
    // What shows nothing but its outline may be any drawing; but a plane that was borne out keeps
    // its picture, though it is faint for a moment.
    if (step.by_outline && !s.plane.is_said()) {
        if (s.plane.is_settled())
            step = {evidence.by_picture};
        else if (s.plane.believed())
            s.leave_plane(*s.last);
    }
    const LatticeField measured = was_hidden ? s.prev_from_cur : std::move(step.prev_from_cur);
    // Where nothing is registered, nothing holds the steps: they would draw it out without end.
    s.follow(was_hidden ? measured : s.believed_step(measured, visible));
    s.prev_from_cur = measured;
    if (step.by_outline) {
        s.register_drawing(cur);
        if (s.plane.is_said())
            s.correct(s.anchors.present_index(), flattened(s.anchor_from_cur, visible));
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
int SurfaceWalker::hiding_frames() const {
    return state_->hiding_frames;
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

void SurfaceWalker::become_part() {
    State& s = *state_;
    s.is_part = true;
    if (s.plane.believed()) s.leave_plane(*s.last);
    s.first_px = s.largest_px = 0;
    s.steady_step = {};
    // No seam hides the change of a part's texture.
    s.hide_reanchoring = false;
    s.hiding_left = 0;
    s.stretched = {};
}

void SurfaceWalker::keep_on_anchors(ViewU8x1 own) {
    State& s = *state_;
    const Size size = s.frame_size();
    s.anchors.each([&](Anchor& anchor) {
        const ImageF2 to_last = inverse(s.predicted(anchor)).dense(rect_of(size));
        const ViewU8x1 visible = anchor.frame->view().visible;
        Matte kept(size);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const float* d = to_last.pixel(x, y);
                const int u =
                    std::clamp(x + static_cast<int>(std::lround(d[0])), 0, size.width - 1);
                const int v =
                    std::clamp(y + static_cast<int>(std::lround(d[1])), 0, size.height - 1);
                kept.at(x, y) = own.at(u, v) != 0 ? visible.at(x, y) : std::uint8_t{0};
            }
        }
        anchor.frame = anchor.frame->part(kept, anchor.frame.get());
    });
}

bool SurfaceWalker::asks_outline() const {
    return state_->asks_outline();
}

bool SurfaceWalker::is_plane() const {
    return state_->plane.believed();
}

int SurfaceWalker::part_count() const {
    return state_->parts.count();
}

void SurfaceWalker::hold() {
    state_->parts.hold();
    state_->prev_from_cur = LatticeField(state_->frame_size(), state_->options.spacing_px);
}

void SurfaceWalker::anchor_here(const LatticeField* ref_from_here) {
    if (state_->parts.any()) {
        state_->parts.anchor_here(ref_from_here);
        state_->ref_from_cur = state_->parts.ref_from_cur();
        return;
    }
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
