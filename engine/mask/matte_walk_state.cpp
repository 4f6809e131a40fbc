#include "engine/mask/matte_walk_state.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/copy_of.h"
#include "engine/mask/growth_evidence.h"
#include "engine/mask/hidden_part.h"
#include "engine/mask/key_places.h"
#include "engine/mask/match_evidence.h"
#include "engine/mask/nearest_pixel.h"
#include "engine/mask/signed_distance.h"
#include "engine/mask/soft_matting.h"
#include "engine/mask/taken_over.h"

namespace weft {
namespace {

// Of the new frame, only what lies well outside the expected boundary counts: new background.
constexpr float kUnsureClearancePx = 6;
constexpr float kFarBands = 0.8f;  // motion that leads so far outside is believed

}  // namespace

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

// Nothing of the surface is on the frame.
void MatteWalker::State::leave_frame(const FlowField& prev_from_cur) {
    confidence = 0;
    confirmed.clear();
    departure.advance({phi, prev_from_cur, {}, {}, {}, {}, scale.unit_px()});
    sides = {};
    newcomers = {};
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

// What was not seen outside on the keyframe, and goes on the surface.
void MatteWalker::State::take_ground(const GroundStep& step, ImageF1& distance, Matte& matte) {
    const Matte added = ground.advance(step, palette);
    if (added.empty()) return;
    plate.forget(added);
    departure.correct(added, added);
    take_over(inside_with(distance, added), scale.limit_px, distance, matte);
}

MatteEstimate MatteWalker::State::estimate(Matte matte) const {
    return {std::move(matte), confidence, confirmed.since(), since_confidence,
            followed ? followed->known() : Matte()};
}

// What was uncovered and taken for surface goes out when it is left behind, and an island that was
// outside goes at once. Returns it; empty: none.
Matte MatteWalker::State::drop_islands(ViewU8x3 now, const FlowField& prev_from_cur,
                                       ViewF2 background, ImageF1& distance, Matte& matte) {
    Matte islands =
        left_behind.advance({now, distance, phi, newcomers.entered(), prev_from_cur, background,
                             key_frame, key_phi, palette, key_from_prev, scale.unit_px()});
    if (!islands.empty())
        take_over(inside_without(distance, islands), scale.limit_px, distance, matte);
    return islands;
}

}  // namespace weft
