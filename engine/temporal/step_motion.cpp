#include "engine/temporal/step_motion.h"

#include <algorithm>
#include <utility>

#include "engine/motion/contour_flow.h"
#include "engine/motion/photometric_register.h"
#include "engine/motion/surface_fit.h"

namespace weft {
namespace {

LatticeField by_picture(const OutlineView& cur, const FlowField& prev_from_cur, int spacing_px) {
    constexpr int kBorder_px = 6;
    SurfaceFitOptions fit;
    fit.spacing_px = spacing_px;
    return fit_surface_motion(
        prev_from_cur.d, motion_weights(cur.luma, cur.visible, prev_from_cur.valid, kBorder_px),
        fit);
}

LatticeField by_outline(const StepFrame& prev, const StepFrame& cur, int spacing_px) {
    const OutlineView before = prev.view(), now = cur.view();
    const FlowField motion =
        estimate_contour_flow(now.luma, now.extent, before.luma, before.extent);
    SurfaceFitOptions fit;
    fit.spacing_px = spacing_px;
    fit.finest_px = 12;
    fit.correlation_px = 4;
    return register_outline(prev.outline(), cur.outline(),
                            fit_surface_motion(motion.d, motion.valid, fit));
}

Matte copy_of(ViewU8x1 v) {
    Matte out(v.size());
    for (int y = 0; y < v.height(); ++y)
        std::copy(v.row(y), v.row(y) + v.width(), out.row(y));
    return out;
}

// The outline's motion of a thing with limbs lies near the truth, and so does that of a plane whose
// outline has corners: the picture's own has to be clearly better, or to be found again almost
// everywhere. (Picture and outline: plaster 0.36 and 0.17, a floor of faint tiles 0.83 and 0.80;
// blender_fox_gt's fox, which the outline holds better, 0.55 and 0.51, at most 0.72; assets/drawn
// 0.11 to 0.62 and 0.23 to 0.64.)
double lead_of(double picture, double outline) {
    constexpr double kClearly = 1.3, kAlmostEverywhere = 0.75;
    return std::max(picture - kClearly * outline, picture - kAlmostEverywhere);
}

}  // namespace

void MotionChoice::note(double picture, double outline) {
    constexpr double kShare = 0.2, kClear = 0.02;
    constexpr double kByChance = 0.03;  // grain alone has 0.01
    // A frame that shows neither, black or blurred, is no reason to change.
    if (std::max(picture, outline) < kByChance) return;
    const double lead = lead_of(picture, outline);
    if (!lead_) {
        lead_ = lead;
        by_outline_ = lead <= 0;
        return;
    }
    *lead_ += kShare * (lead - *lead_);
    if (by_outline_ ? *lead_ > kClear : *lead_ < -kClear) by_outline_ = !by_outline_;
}

StepFrame::StepFrame(ViewU8x1 luma, ViewU8x1 visible, ViewU8x1 extent)
    : luma_(copy_of(luma)), extent_(copy_of(extent)), visible_(copy_of(visible)) {}

const RegistrationPicture& StepFrame::picture() const {
    std::call_once(picture_made_, [&] { picture_ = registration_picture(luma_, visible_); });
    return *picture_;
}

const OutlineShape& StepFrame::outline() const {
    if (!outline_) outline_.emplace(view());
    return *outline_;
}

StepEvidence gather_evidence(const StepFrame& prev, const StepFrame& cur,
                             const FlowField& prev_from_cur, int spacing_px) {
    constexpr float kEnough = 1.25f;
    const OutlineView before = prev.view(), now = cur.view();
    StepEvidence out{by_picture(now, prev_from_cur, spacing_px), {}, 0, 0};
    if (structure_to_noise(now.luma, now.visible, before.luma, before.visible, prev_from_cur) >=
        kEnough) {
        return out;
    }
    // Faint plaster and a flat fill have as little structure for one pixel. What is faint is found
    // again by its own motion all the same, and by the outline's only where that is right.
    out.by_outline = by_outline(prev, cur, spacing_px);
    out.for_picture = registration_evidence(prev.picture(), cur.picture(), out.by_picture);
    out.for_outline = registration_evidence(prev.picture(), cur.picture(), *out.by_outline);
    return out;
}

StepMotion choose_motion(const StepEvidence& evidence, MotionChoice& choice) {
    if (!evidence.by_outline) return {evidence.by_picture, false};
    choice.note(evidence.for_picture, evidence.for_outline);
    const bool outline = choice.by_outline();
    return {outline ? *evidence.by_outline : evidence.by_picture, outline};
}

LatticeField fit_exact_motion(ViewU8x1 luma, ViewU8x1 visible, const FlowField& prev_from_cur,
                              int spacing_px) {
    constexpr int kBorder_px = 2;
    SurfaceFitOptions fit;
    fit.spacing_px = spacing_px;
    fit.finest_px = 8;
    fit.correlation_px = 1;
    fit.noise_floor_px = 0.005f;
    return fit_surface_motion(prev_from_cur.d,
                              motion_weights(luma, visible, prev_from_cur.valid, kBorder_px), fit);
}

}  // namespace weft
