#include "engine/mask/matte_propagation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/mask/background_motion.h"
#include "engine/mask/copy_of.h"
#include "engine/mask/hidden_part.h"
#include "engine/mask/key_places.h"
#include "engine/mask/matte_walk_state.h"
#include "engine/mask/painted_sides.h"
#include "engine/mask/signed_distance.h"
#include "engine/mask/soft_matting.h"
#include "engine/mask/taken_over.h"
#include "engine/motion/held_frames.h"

namespace weft {
namespace {

constexpr float kWidestEdgeBands = 2;  // hair reaches 20 px at 854×480

// Confidence falls with each frame whose boundary had to be guessed. It ranks frames by quality and
// is not calibrated to be the overlap itself.
float confidence_kept(const BoundaryEvidence& e, float consistency) {
    const float risk = (1 - e.separability) + (1 - e.certainty) + 0.5f * (1 - e.steadiness) +
                       0.5f * (1 - consistency);
    return std::exp(-0.1f * risk);
}

}  // namespace

MatteWalker::MatteWalker(ViewU8x3 frame, ViewU8x1 key, const MatteOptions& options,
                         ViewU8x1 in_front) {
    const RefineScale scale(frame.size());
    ImageF1 phi = smooth_distance(signed_distance(inside_of(key), scale.limit_px), 1);
    const Matte covered = hidden_part(in_front);
    const ImageF1 seen = covered.empty() ? ImageF1() : seen_distance(phi, covered);
    const ImageF1& known = covered.empty() ? phi : seen;
    state_ = std::make_unique<State>(State{copy_of(frame),
                                           phi,
                                           copy_of(frame),
                                           phi,
                                           seen,
                                           seen,
                                           own_places(frame.size()),
                                           scale,
                                           BackgroundPlate(frame, known),
                                           SurfacePalette(frame, known, scale.band_px),
                                           options,
                                           1.0f,
                                           {},
                                           0.0f,
                                           copy_of(key),
                                           SurfaceReturn(frame, phi),
                                           FlatFills(frame, phi),
                                           Departure(phi),
                                           MotionReturn(phi),
                                           PartReturn(phi),
                                           RestingScene(frame, known),
                                           UnseenGround(frame, known)});
    const float widest_px = kWidestEdgeBands * scale.band_px;
    state_->key_softness = edge_softness(key, shape_without_strands(phi, 2 * widest_px), widest_px);
    const ImageF1& softness = state_->key_softness;
    state_->soft_edges =
        std::any_of(softness.data(), softness.data() + softness.size_bytes() / sizeof(float),
                    [](float half_width) { return half_width > 0; });
    state_->clearance_px = clearance_of(phi, state_->key_softness);
    if (options.merged) state_->followed.emplace(frame.size());
}

MatteWalker::MatteWalker(const MatteWalker& other)
    : state_(std::make_unique<State>(*other.state_)) {}
MatteWalker::~MatteWalker() = default;
MatteWalker::MatteWalker(MatteWalker&&) noexcept = default;
MatteWalker& MatteWalker::operator=(MatteWalker&&) noexcept = default;

MatteEstimate MatteWalker::confirm(const ConfirmedPart& part) {
    State& s = *state_;
    s.at_key = false;
    Matte inside(s.last.size()), wrong(s.last.size());
    bool any = false;
    for (int y = 0; y < inside.height(); ++y) {
        for (int x = 0; x < inside.width(); ++x) {
            const bool was = s.phi.at(x, y) > 0;
            const bool is = is_confirmed(part.area.at(x, y)) ? part.matte.at(x, y) > 127 : was;
            inside.at(x, y) = is ? 255 : 0;
            if (is == was) continue;
            wrong.at(x, y) = 255;
            any = true;
        }
    }
    if (any) {
        take_over(inside, s.scale.limit_px, s.phi, s.last);
        move_seen(s.seen, s.phi);
        s.plate.forget(wrong);
        s.plate.update(s.frame, s.seen_phi());
        s.departure.correct(wrong, inside);
        s.sides.forget(wrong);
        s.newcomers.forget(wrong);
        s.scene.correct(wrong, inside);
        s.ground.correct(wrong, inside);
    }
    s.last = with_confirmed(std::move(s.last), part);
    s.confirmed.add(part.area);
    s.since_confidence = 1;
    if (s.followed) s.followed->know(part.area);
    return s.estimate(s.last);
}

std::vector<Matte> MatteWalker::take_late() {
    return std::exchange(state_->late, {});
}

bool MatteWalker::has_soft_edges() const {
    return state_->soft_edges;
}

// The walk goes by what was meant, not by what was painted loosely, as soon as something moves.
void MatteWalker::begin_again(ViewU8x3 next, const FlowField& measured, bool hides) {
    State& s = *state_;
    const Matte all(s.frame.size(), 255);
    if (!s.at_key || same_drawing({s.frame, all, {}}, {next, all, {}})) return;
    s.at_key = false;
    const Matte meant =
        hides ? Matte() : painted_sides({s.frame, s.last, next, measured, s.scale.unit_px()});
    if (meant.empty()) return;
    const KeyExposure exposure = s.exposure;
    *this = MatteWalker(s.frame, meant, s.options);
    state_->exposure = exposure;
    state_->at_key = false;
}

MatteEstimate MatteWalker::advance(ViewU8x3 shown, const FlowField& measured, ViewU8x1 in_front) {
    const Matte covered = hidden_part(in_front);
    ImageU8x3 evened = state_->exposure.evened(shown, state_->frame, measured);
    const ViewU8x3 frame = evened;
    begin_again(frame, measured, !covered.empty() || !state_->key_seen.empty());
    State& s = *state_;
    const FlowField behind =
        covered.empty() ? FlowField() : motion_behind(measured, covered, s.phi, s.scale.band_px);
    const FlowField& prev_from_cur = covered.empty() ? measured : behind;
    const ImageF2 background = background_motion(s.phi, prev_from_cur, s.scale.band_px);
    Matte matte(frame.size());
    const Recti area =
        working_area(transported_bounds(s.phi, prev_from_cur), s.scale, frame.size());
    ImageF1 phi(frame.size(), -s.scale.limit_px);
    ImageF2 surface_motion;
    s.plate.move(background);
    s.hidden.move(background);
    if (area.empty()) {
        s.leave_frame(prev_from_cur);
    } else {
        const ViewU8x3 part = frame.crop(area);
        TransportedShape shape =
            transport_shape({s.phi, s.seen_phi()}, prev_from_cur, {part, s.palette}, area, s.scale,
                            s.uncovered, covered);
        const ImageF2 key_from_cur = follow_places(s.key_from_prev, shape.prev_from_cur, area);
        const RefinedBoundary found =
            s.find_boundary(part, shape, key_from_cur, prev_from_cur, area, covered);
        const float kept = confidence_kept(found.evidence, shape.consistency);
        s.confidence *= kept;
        s.since_confidence *= kept;
        s.confirmed.move(shape.prev_from_cur, area);
        paste(matte, s.soften(part, found, key_from_cur, shape.prev_from_cur, area), area);
        paste(phi, found.phi, area);
        paste(s.key_from_prev, key_from_cur, area);
        s.hidden.follow(found.phi, key_from_cur, area);
        s.newcomers.settle(phi);
        surface_motion = std::move(shape.prev_from_cur);
    }
    const Matte dropped = s.drop_islands(frame, prev_from_cur, background, phi, matte);
    s.take_back(frame, prev_from_cur, phi, matte);
    s.take_whole_fills(frame, phi, matte);
    s.take_as_scene(frame, prev_from_cur, covered, phi, matte);
    const Matte parting = parting_pixels(measured, rect_of(frame.size()));
    s.take_ground({frame, s.frame, measured, parting, surface_motion, area, s.phi, phi,
                   s.scale.unit_px(), dropped},
                  phi, matte);
    if (s.followed) s.followed->advance({measured, parting, surface_motion, area, s.phi, phi});
    s.phi = std::move(phi);
    s.seen = covered.empty() ? ImageF1() : seen_distance(s.phi, covered);
    s.plate.update(frame, s.seen_phi());
    s.late = s.scene.remember(s.seen_phi(), s.palette);
    if (!covered.empty()) s.late.clear();
    if (!s.lost.lost(s.phi)) s.palette.follow(frame, s.seen_phi(), s.scale.band_px);
    s.frame = std::move(evened);
    s.last = std::move(matte);
    return s.estimate(s.last);
}

}  // namespace weft
