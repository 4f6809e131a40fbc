#include "engine/mask/matte_propagation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/background_motion.h"
#include "engine/mask/background_plate.h"
#include "engine/mask/boundary_refiner.h"
#include "engine/mask/copy_of.h"
#include "engine/mask/departure.h"
#include "engine/mask/flat_fills.h"
#include "engine/mask/followed.h"
#include "engine/mask/growth_evidence.h"
#include "engine/mask/hidden_part.h"
#include "engine/mask/key_places.h"
#include "engine/mask/left_behind.h"
#include "engine/mask/match_evidence.h"
#include "engine/mask/motion_return.h"
#include "engine/mask/motion_sides.h"
#include "engine/mask/nearest_pixel.h"
#include "engine/mask/newcomers.h"
#include "engine/mask/painted_sides.h"
#include "engine/mask/part_return.h"
#include "engine/mask/resting_scene.h"
#include "engine/mask/shape_transport.h"
#include "engine/mask/signed_distance.h"
#include "engine/mask/soft_matting.h"
#include "engine/mask/surface_palette.h"
#include "engine/mask/surface_return.h"
#include "engine/mask/taken_over.h"
#include "engine/mask/uncovered.h"
#include "engine/motion/held_frames.h"

namespace weft {
namespace {

// Of the new frame, only what lies well outside the expected boundary counts: new background.
constexpr float kUnsureClearancePx = 6;
constexpr float kFarBands = 0.8f;      // motion that leads so far outside is believed
constexpr float kWidestEdgeBands = 2;  // hair reaches 20 px at 854×480

}  // namespace

struct MatteWalker::State {
    ImageU8x3 frame;  ///< The last frame of the walk …
    ImageF1 phi;      ///< … and the signed distance of its matte's boundary, pixels.
    ImageU8x3 key_frame;
    ImageF1 key_phi;
    ImageF1 seen, key_seen;  ///< As both, 0 where something in front hides it; empty: nowhere.
    ImageF2 key_from_prev;   ///< Where each pixel's surface lay on the keyframe, pixels.
    RefineScale scale;
    BackgroundPlate plate;
    SurfacePalette palette;
    MatteOptions options;
    float confidence = 1;
    ImageF1 key_softness;    ///< Half the width of the keyframe's edge, pixels.
    float clearance_px = 0;  ///< Nearer to the boundary, colours are not used.
    Matte last;              ///< The matte of the walk's last frame.
    SurfaceReturn hidden;
    FlatFills fills;
    Departure departure;
    MotionReturn lost;
    PartReturn part_lost;
    RestingScene scene;
    MotionSides sides = {};
    Uncovered uncovered = {};
    Newcomers newcomers = {};
    LeftBehind left_behind = {};
    ConfirmedPlaces confirmed = {};
    std::optional<Followed> followed = {};  ///< Where walks are merged.
    float since_confidence = 1;             ///< Of what was confirmed last.
    bool soft_edges = false;                ///< Whether key_softness is anything but 0.
    bool at_key = true;                     ///< No step has been made.
    std::vector<Matte> late = {};           ///< Of the frames before, by blocks.

    [[nodiscard]] Matte soften(ViewU8x3 part, const RefinedBoundary& found, ViewF2 key_from_cur,
                               ViewF2 prev_from_cur, const Recti& area) const;
    void take_back(ViewU8x3 now, const FlowField& prev_from_cur, ImageF1& distance, Matte& matte);
    [[nodiscard]] MatteEstimate estimate(Matte matte) const;
    void take_whole_fills(ViewU8x3 now, ImageF1& distance, Matte& matte);
    void take_as_scene(ViewU8x3 now, const FlowField& prev_from_cur, const Matte& covered,
                       ImageF1& distance, Matte& matte);
    void drop_islands(ViewU8x3 now, const FlowField& prev_from_cur, ViewF2 background,
                      ImageF1& distance, Matte& matte);
    LocalColorField fit_colors(ViewU8x3 part, const TransportedShape& shape, ViewF2 key_from_cur,
                               const Recti& area, Matte covered) const;
    RefinedBoundary find_boundary(ViewU8x3 part, const TransportedShape& shape, ViewF2 key_from_cur,
                                  const FlowField& prev_from_cur, const Recti& area,
                                  const Matte& covered);
    [[nodiscard]] const ImageF1& seen_phi() const { return seen.empty() ? phi : seen; }
};

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
                                           SurfacePalette(frame, known),
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
                                           RestingScene(frame, known)});
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

// The surface's colours come from the keyframe, so that a leak is not taken for surface. The
// surroundings change as the surface moves; their colours come from the last frame and from this
// one.
LocalColorField MatteWalker::State::fit_colors(ViewU8x3 part, const TransportedShape& shape,
                                               ViewF2 key_from_cur, const Recti& area,
                                               Matte covered) const {
    std::vector<ColorWindow> windows = place_windows(shape.phi, scale.window_step_px);
    for (ColorWindow& w : windows) {
        const float* d = shape.prev_from_cur.pixel(w.center.x, w.center.y);
        const float* k = key_from_cur.pixel(w.center.x, w.center.y);
        w.source_centers = {nearest_pixel({static_cast<float>(area.x0 + w.center.x) + d[0],
                                           static_cast<float>(area.y0 + w.center.y) + d[1]}),
                            nearest_pixel({k[0], k[1]}), w.center};
    }
    // Neither what is hidden nor what has just appeared is known to be of either side.
    const ImageF1 expected =
        seen_distance(shape.phi, either_of(covered, shape.uncovered.appearing));
    const std::vector<ColorSource> sources = {
        {frame, seen_phi(), clearance_px, 0.3f, 1.0f},
        {key_frame, key_seen.empty() ? key_phi : key_seen, clearance_px, 1.0f, 0.3f},
        {part, expected, kUnsureClearancePx, 0.0f, 0.2f}};
    LocalColorField colors(std::move(windows), sources, scale.window_half_px, scale.sample_stride,
                           part.size());
    colors.leave_out(std::move(covered));
    return colors;
}

// The boundary near where the shape's motion leads. What something in front hides says nothing.
RefinedBoundary MatteWalker::State::find_boundary(ViewU8x3 part, const TransportedShape& shape,
                                                  ViewF2 key_from_cur,
                                                  const FlowField& prev_from_cur, const Recti& area,
                                                  const Matte& covered) {
    const Vec2i origin(area.x0, area.y0);
    const LocalColorField colors =
        fit_colors(part, shape, key_from_cur, area,
                   covered.empty() ? Matte() : copy_of(covered.view().crop(area)));
    ImageF1 matched = match_evidence({part, shape.phi, shape.prev_from_cur, shape.outside_motion,
                                      origin, frame, seen_phi(), prev_from_cur.d},
                                     scale.band_px);
    const GrowthInput growth{part,  shape.phi, shape.prev_from_cur, area,
                             frame, phi,       &prev_from_cur};
    ImageF1 wide =
        plate.odds(part, shape.phi, surface_difference(growth, palette, scale.band_px), area);
    limit_growth(wide, growth, palette, kFarBands * scale.band_px);
    judge_uncovered(part, shape.uncovered, colors, palette, matched, wide);
    add_sides(sides.advance({phi, prev_from_cur, shape.outside_motion, area, scale.unit_px()}),
              shape.phi, matched, wide);
    add_odds(departure.advance(
                 {phi, prev_from_cur, shape.prev_from_cur, part, frame, area, scale.unit_px()}),
             palette, part, area, matched, wide);
    add_newcomers(newcomers.advance({part, frame, phi, prev_from_cur, shape.outside_motion,
                                     shape.uncovered.appearing, shape.phi, area, scale.unit_px()}),
                  matched, wide);
    if (!covered.empty()) keep_hidden(matched, wide, shape.phi, covered, origin);
    return refine_boundary(part, shape.phi, colors, matched, wide, scale, options.steadiness);
}

// Hair, fur and motion blur stay where they were on the keyframe, warped along the motion.
Matte MatteWalker::State::soften(ViewU8x3 part, const RefinedBoundary& found, ViewF2 key_from_cur,
                                 ViewF2 prev_from_cur, const Recti& area) const {
    if (!soft_edges) return found.matte;
    ImageF1 softness(part.size());
    Matte expected(part.size());
    parallel_rows(part.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < part.width(); ++x) {
                const float* k = key_from_cur.pixel(x, y);
                softness.at(x, y) = sample_bilinear(key_softness, k[0], k[1]);
                const float* d = prev_from_cur.pixel(x, y);
                const Vec2i p = nearest_pixel(Vec2(area.x0 + x, area.y0 + y) + Vec2(d[0], d[1]));
                expected.at(x, y) = last.at(std::clamp(p.x, 0, last.width() - 1),
                                            std::clamp(p.y, 0, last.height() - 1));
            }
        }
    });
    return with_soft_edges(part, found.phi, softness, found.matte, expected, options.steadiness);
}

// Adds what was hidden and is seen again, by its pattern; or else takes what moves as a whole in
// place of the little that was found.
void MatteWalker::State::take_back(ViewU8x3 now, const FlowField& prev_from_cur, ImageF1& distance,
                                   Matte& matte) {
    const MotionReturnInput evidence{now,     distance,       prev_from_cur, departure.departs(),
                                     palette, scale.unit_px()};
    Matte returned = hidden.returned(now, distance);
    bool whole = returned.empty();
    if (whole) returned = lost.returned(evidence);
    if (returned.empty()) {
        returned = part_lost.returned(evidence);
        whole = false;
    }
    if (returned.empty()) return;
    constexpr float kOfFound = 0.25f;  // after it had been lost altogether
    confidence = std::max(confidence, kOfFound);
    departure.correct(returned, returned);
    const ImageF1 inside = smooth_distance(signed_distance(returned, scale.limit_px), 1);
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            const float depth = inside.at(x, y);
            const bool known = distance.at(x, y) > 0;
            const auto code =
                static_cast<std::uint8_t>(std::lround(255 * std::clamp(0.5f + depth, 0.0f, 1.0f)));
            matte.at(x, y) = whole ? code : std::max(matte.at(x, y), code);
            distance.at(x, y) = whole ? depth : std::max(distance.at(x, y), depth);
            if (known) continue;
            // Also where it may grow to next.
            const Vec2 place = whole ? lost.key_place(x, y) : hidden.key_place(x, y);
            key_from_prev.pixel(x, y)[0] = place.x;
            key_from_prev.pixel(x, y)[1] = place.y;
        }
    }
}

// Of drawn animation: fills between lines belong to the surface as a whole, or not at all.
void MatteWalker::State::take_whole_fills(ViewU8x3 now, ImageF1& distance, Matte& matte) {
    const Matte whole = fills.corrected(now, distance);
    if (!whole.empty()) take_over(whole, scale.limit_px, distance, matte);
}

// Of a scene at rest: what was hidden comes back, and what passes in front goes.
void MatteWalker::State::take_as_scene(ViewU8x3 now, const FlowField& prev_from_cur,
                                       const Matte& covered, ImageF1& distance, Matte& matte) {
    const Matte inside = scene.corrected(
        now, covered.empty() ? distance : seen_distance(distance, covered), prev_from_cur, palette);
    if (inside.empty()) return;
    const Matte wrong = differing(inside, distance);
    plate.forget(wrong);
    departure.correct(wrong, inside);
    take_over(inside, scale.limit_px, distance, matte);
}

MatteEstimate MatteWalker::State::estimate(Matte matte) const {
    return {std::move(matte), confidence, confirmed.since(), since_confidence,
            followed ? followed->known() : Matte()};
}

// What was uncovered and taken for surface goes out when it is left behind, and an island that was
// outside goes at once.
void MatteWalker::State::drop_islands(ViewU8x3 now, const FlowField& prev_from_cur,
                                      ViewF2 background, ImageF1& distance, Matte& matte) {
    const Matte islands =
        left_behind.advance({now, distance, phi, newcomers.entered(), prev_from_cur, background,
                             key_frame, key_phi, palette, key_from_prev, scale.unit_px()});
    if (!islands.empty())
        take_over(inside_without(distance, islands), scale.limit_px, distance, matte);
}

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
    *this = MatteWalker(s.frame, meant, s.options);
    state_->at_key = false;
}

MatteEstimate MatteWalker::advance(ViewU8x3 frame, const FlowField& measured, ViewU8x1 in_front) {
    const Matte covered = hidden_part(in_front);
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
    if (area.empty()) {  // the surface has left the frame
        s.confidence = 0;
        s.confirmed.clear();
        s.departure.advance({s.phi, prev_from_cur, {}, {}, {}, {}, s.scale.unit_px()});
        s.sides = {};
        s.newcomers = {};
    } else {
        TransportedShape shape = transport_shape({s.phi, s.seen_phi()}, prev_from_cur, area,
                                                 s.scale, s.uncovered, covered);
        const ViewU8x3 part = frame.crop(area);
        const ImageF2 key_from_cur = follow_places(s.key_from_prev, shape.prev_from_cur, area);
        const RefinedBoundary found =
            s.find_boundary(part, shape, key_from_cur, prev_from_cur, area, covered);
        // Confidence falls with each frame whose boundary had to be guessed. It ranks frames by
        // quality and is not calibrated to be the overlap itself.
        const BoundaryEvidence& e = found.evidence;
        const float risk = (1 - e.separability) + (1 - e.certainty) + 0.5f * (1 - e.steadiness) +
                           0.5f * (1 - shape.consistency);
        s.confidence *= std::exp(-0.1f * risk);
        s.since_confidence *= std::exp(-0.1f * risk);
        s.confirmed.move(shape.prev_from_cur, area);
        paste(matte, s.soften(part, found, key_from_cur, shape.prev_from_cur, area), area);
        paste(phi, found.phi, area);
        paste(s.key_from_prev, key_from_cur, area);
        s.hidden.follow(found.phi, key_from_cur, area);
        s.newcomers.settle(phi);
        surface_motion = std::move(shape.prev_from_cur);
    }
    s.drop_islands(frame, prev_from_cur, background, phi, matte);
    s.take_back(frame, prev_from_cur, phi, matte);
    s.take_whole_fills(frame, phi, matte);
    s.take_as_scene(frame, prev_from_cur, covered, phi, matte);
    if (s.followed) s.followed->advance({measured, surface_motion, area, s.phi, phi});
    s.phi = std::move(phi);
    s.seen = covered.empty() ? ImageF1() : seen_distance(s.phi, covered);
    s.plate.update(frame, s.seen_phi());
    s.late = s.scene.remember(s.seen_phi(), s.palette);
    if (!covered.empty()) s.late.clear();
    if (!s.lost.lost(s.phi)) s.palette.follow(frame, s.seen_phi(), s.scale.band_px);
    s.frame = copy_of(frame);
    s.last = std::move(matte);
    return s.estimate(s.last);
}

}  // namespace weft
