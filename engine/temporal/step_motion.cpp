#include "engine/temporal/step_motion.h"

#include <algorithm>
#include <utility>

#include "engine/motion/contour_flow.h"
#include "engine/motion/photometric_register.h"
#include "engine/motion/surface_fit.h"
#include "engine/motion/surface_flow.h"

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

// The most that one frame adds: a single one is no reason to change.
constexpr double kMostLead = 4;

}  // namespace

void MotionChoice::note(double lead) {
    constexpr double kShare = 0.2;
    // Standard errors. (Plaster, tiles, a faint cloth: 2.8 to 8 in each frame. blender_fox_gt's
    // fox, whose speckle is new in each: -2.9 to 0.6; flat drawn fills -5 to 0.4.)
    constexpr double kPicture = 1.5, kOutline = -0.5;
    lead = std::clamp(lead, -kMostLead, kMostLead);
    if (!lead_) {
        lead_ = lead;
        by_outline_ = lead <= kPicture;
        return;
    }
    *lead_ += kShare * (lead - *lead_);
    if (by_outline_ ? *lead_ > kPicture : *lead_ < kOutline) by_outline_ = !by_outline_;
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
                             const FlowField& prev_from_cur, FlowQuality quality, int spacing_px) {
    constexpr float kEnough = 1.25f;
    const OutlineView before = prev.view(), now = cur.view();
    const RegistrationPicture &there = prev.picture(), &here = cur.picture();
    StepEvidence out{by_picture(now, prev_from_cur, spacing_px), {}, 0};
    const FlowField flow =
        estimate_surface_flow({here, now.visible}, {there, before.visible}, cur.size(), quality);
    // Under grain, or where little of the surface is in view, the plate's own motion is steadier.
    LatticeField freed = by_picture(now, flow, spacing_px);
    if (registration_lead(there, here, freed, out.by_picture) > 0)
        out.by_picture = std::move(freed);
    if (structure_to_noise(now.luma, now.visible, before.luma, before.visible, prev_from_cur) >=
        kEnough) {
        return out;
    }
    // Faint plaster and a flat fill have as little structure for one pixel. What is faint is found
    // again by its own motion all the same, and by the outline's only where that is right.
    out.by_outline = by_outline(prev, cur, spacing_px);
    out.lead = registration_lead(there, here, out.by_picture, *out.by_outline);
    return out;
}

StepMotion choose_motion(const StepEvidence& evidence, MotionChoice& choice) {
    // Structure that stands out speaks for the picture where it does not for a moment, too.
    choice.note(evidence.by_outline ? evidence.lead : kMostLead);
    if (!evidence.by_outline) return {evidence.by_picture, false};
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
