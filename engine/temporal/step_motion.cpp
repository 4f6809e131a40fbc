#include "engine/temporal/step_motion.h"

#include <algorithm>
#include <utility>

#include "engine/motion/contour_flow.h"
#include "engine/motion/flat_motion.h"
#include "engine/motion/photometric_register.h"
#include "engine/motion/surface_fit.h"
#include "engine/motion/surface_flow.h"
#include "engine/temporal/outline_evidence.h"
#include "engine/temporal/tiny_surface.h"

namespace weft {
namespace {

Matte weights_of(ViewU8x1 luma, ViewU8x1 visible, const FlowField& prev_from_cur) {
    constexpr int kBorder_px = 6;
    return motion_weights(luma, visible, prev_from_cur.valid, kBorder_px);
}

LatticeField by_picture(const FlowField& prev_from_cur, ViewU8x1 weights, int spacing_px) {
    SurfaceFitOptions fit;
    fit.spacing_px = spacing_px;
    return fit_surface_motion(prev_from_cur.d, weights, fit);
}

// The picture's motion as one plane, where its own bends find no more than chance would: a piece of
// a brick wall that an occluder cuts off finds itself again a brick further, too.
LatticeField flat_or_bent(const StepFrame& prev, const StepFrame& cur,
                          const FlowField& prev_from_cur, int spacing_px) {
    constexpr double kOfChance = 0.5;
    const OutlineView now = cur.view();
    const Matte weights = weights_of(now.luma, now.visible, prev_from_cur);
    LatticeField bent = by_picture(prev_from_cur, weights, spacing_px);
    LatticeField flat = fit_flat_motion(prev_from_cur.d, weights, spacing_px);
    const RegistrationLead lead = registration_lead(prev.picture(), cur.picture(), bent, flat);
    return lead.errors < kOfChance ? flat : bent;
}

Matte copy_of(ViewU8x1 v) {
    Matte out(v.size());
    for (int y = 0; y < v.height(); ++y)
        std::copy(v.row(y), v.row(y) + v.width(), out.row(y));
    return out;
}

// The most that one frame adds: a single one is no reason to change.
constexpr double kMostLead = 4;

// The share of the surface whose motion is known.
double known_share(const FlowField& flow, ViewU8x1 visible) {
    std::int64_t inside = 0, known = 0;
    for (int y = 0; y < visible.height(); ++y) {
        const std::uint8_t *seen = visible.row(y), *valid = flow.valid.row(y);
        for (int x = 0; x < visible.width(); ++x) {
            inside += seen[x] >= 128;
            known += seen[x] >= 128 && valid[x] != 0;
        }
    }
    return inside == 0 ? 0 : static_cast<double>(known) / static_cast<double>(inside);
}

// Adds the motion of the colours, which both frames have. Shades move over luma, and not over
// these.
void add_color(const StepFrame& prev, const StepFrame& cur, FlowQuality quality, int spacing_px,
               StepEvidence& out) {
    const OutlineView before = prev.view(), now = cur.view();
    const RegistrationPicture &there = prev.color_picture(), &here = cur.color_picture();
    const FlowField flow =
        estimate_surface_flow({here, now.visible}, {there, before.visible}, cur.size(), quality);
    out.by_color = by_picture(flow, weights_of(cur.color(), now.visible, flow), spacing_px);
    const bool freed = out.by_freed && *out.freed_lead > 0;
    const RegistrationLead lead =
        registration_lead(there, here, *out.by_color, freed ? *out.by_freed : out.by_picture);
    out.color_lead = lead.errors == 0 ? 0 : lead.errors - kOfTheFit;
}

// Adds the motion of the pictures freed of light to `out`.
void add_freed(const StepFrame& prev, const StepFrame& cur, const FlowField& prev_from_cur,
               FlowQuality quality, int spacing_px, StepEvidence& out) {
    // A fiftieth of the surface weighs as much as a standard error, of which more than two say no
    // more: over a wide surface they come from the least difference.
    constexpr double kShareWeight = 50, kMostErrors = 2;
    // Motion that is so much less consistent is not worth its fit.
    constexpr double kHopeless = -4;
    const OutlineView before = prev.view(), now = cur.view();
    const RegistrationPicture &there = prev.picture(), &here = cur.picture();
    const FlowField flow =
        estimate_surface_flow({here, now.visible}, {there, before.visible}, cur.size(), quality);
    const double steadier =
        kShareWeight * (known_share(flow, now.visible) - known_share(prev_from_cur, now.visible));
    out.freed_lead = steadier;
    if (steadier < kHopeless) return;
    out.by_freed = by_picture(flow, weights_of(now.luma, now.visible, flow), spacing_px);
    out.freed_lead =
        steadier + std::clamp(registration_lead(there, here, *out.by_freed, out.by_picture).errors,
                              -kMostErrors, kMostErrors);
}

}  // namespace

void MotionChoice::Lead::note(double lead, int frames, double above, double below) {
    noted = std::min(noted + 1, frames);
    mean += (std::clamp(lead, -kMostLead, kMostLead) - mean) / noted;
    leads = mean > (leads ? below : above);
}

void MotionChoice::note(double lead) {
    constexpr int kFrames = 8;
    constexpr double kPicture = 0.4, kOutline = 0.2;
    if (lead == 0) return;  // nothing could be compared
    picture_.note(lead, kFrames, kPicture, kOutline);
}

void MotionChoice::note_freed(double lead) {
    constexpr int kFrames = 5;
    constexpr double kFreed = 1.25, kPlate = 0.75;
    freed_.note(lead, kFrames, kFreed, kPlate);
}

void MotionChoice::note_color(double lead) {
    constexpr int kFrames = 5;
    constexpr double kColor = 1.25, kLuma = 0.75;
    if (lead == 0) return;  // nothing could be compared
    color_.note(lead, kFrames, kColor, kLuma);
}

void MotionChoice::note_lines(double lead) {
    constexpr int kFrames = 8;
    constexpr double kLines = 0.6, kPicture = -0.5;
    if (lead == 0) return;  // nothing could be compared
    lines_.note(-lead, kFrames, kLines, kPicture);
}

StepFrame::StepFrame(ViewU8x1 luma, ViewU8x1 visible, ViewU8x1 extent)
    : luma_(copy_of(luma)), extent_(copy_of(extent)), visible_(copy_of(visible)) {}

StepFrame::StepFrame(ViewU8x1 luma, ViewU8x1 visible, ViewU8x1 extent,
                     std::shared_ptr<const ImageU8x3> display, const StepFrame* before)
    : StepFrame(luma, visible, extent) {
    display_ = std::move(display);
    axis_ = before ? before->axis_ : color_axis(*display_, visible);
    if (axis_) color_ = weft::color_picture(*display_, *axis_);
}

const ImageU8x3& StepFrame::display() const {
    static const ImageU8x3 kNone;
    return display_ ? *display_ : kNone;
}

std::shared_ptr<const StepFrame> StepFrame::part(ViewU8x1 visible, const StepFrame* before) const {
    if (!display_) return std::make_shared<const StepFrame>(luma_, visible, visible);
    return std::make_shared<const StepFrame>(luma_, visible, visible, display_, before);
}

const RegistrationPicture& StepFrame::picture() const {
    std::call_once(picture_made_, [&] { picture_ = registration_picture(luma_, visible_); });
    return *picture_;
}

const RegistrationPicture& StepFrame::color_picture() const {
    std::call_once(color_picture_made_,
                   [&] { color_picture_ = registration_picture(color_, visible_); });
    return *color_picture_;
}

const OutlineShape& StepFrame::outline() const {
    std::call_once(outline_made_, [&] { outline_.emplace(view()); });
    return *outline_;
}

namespace {

// What the picture inside says. Returns structure_to_noise().
float add_picture(const StepFrame& prev, const StepFrame& cur, const FlowField& prev_from_cur,
                  FlowQuality quality, int spacing_px, StepEvidence& out) {
    const OutlineView before = prev.view(), now = cur.view();
    // Where the surface is found again almost everywhere, nothing is left to be explained; but
    // shades alone are found again, too, and leave its colours behind.
    constexpr double kAlmostEverywhere = 0.95, kLeftBehind = 0.6;
    const bool found =
        registration_agreement(prev.picture(), cur.picture(), out.by_picture) >= kAlmostEverywhere;
    if (!found) add_freed(prev, cur, prev_from_cur, quality, spacing_px, out);
    if (prev.has_color() && cur.has_color() &&
        (!found || registration_agreement(prev.color_picture(), cur.color_picture(),
                                          out.by_picture) < kLeftBehind))
        add_color(prev, cur, quality, spacing_px, out);
    const float structure =
        structure_to_noise(now.luma, now.visible, before.luma, before.visible, prev_from_cur);
    // A drawn fill shows no parts (0.0), a figure on a large, soft plate does (0.9 to 1.2).
    constexpr float kShowsParts = 0.8f;
    out.faint = structure < kStandsOut;
    if (structure >= kShowsParts) out.parts = find_moving_parts(prev_from_cur, now.visible);
    return structure;
}

}  // namespace

StepEvidence gather_evidence(const StepFrame& prev, const StepFrame& cur,
                             const FlowField& prev_from_cur, FlowQuality quality, int spacing_px) {
    StepEvidence out;
    out.by_picture = flat_or_bent(prev, cur, prev_from_cur, spacing_px);
    if (is_tiny(prev) && is_tiny(cur)) {
        out.by_picture =
            tiny_motion(prev, cur, out.by_picture, outline_motion(prev, cur, spacing_px));
        return out;
    }
    const float structure = add_picture(prev, cur, prev_from_cur, quality, spacing_px, out);
    add_outline(prev, cur, prev_from_cur, structure, spacing_px, out);
    return out;
}

StepEvidence picture_evidence(std::shared_ptr<const StepFrame> prev,
                              std::shared_ptr<const StepFrame> cur,
                              std::shared_ptr<const FlowField> prev_from_cur, FlowQuality quality,
                              int spacing_px) {
    StepEvidence out;
    if (is_tiny(*prev) && is_tiny(*cur)) {
        out = gather_evidence(*prev, *cur, *prev_from_cur, quality, spacing_px);
        out.raw = std::move(prev_from_cur);
        return out;
    }
    out.by_picture = flat_or_bent(*prev, *cur, *prev_from_cur, spacing_px);
    const float structure = add_picture(*prev, *cur, *prev_from_cur, quality, spacing_px, out);
    out.raw = std::move(prev_from_cur);
    out.open = std::make_shared<const OutlineEvidence>(out, std::move(prev), std::move(cur),
                                                       structure, spacing_px);
    return out;
}

StepMotion choose_motion(const StepEvidence& evidence, MotionChoice& choice) {
    // Structure that stands out speaks for the picture where it does not for a moment, too.
    choice.note(evidence.by_outline ? evidence.lead : kMostLead);
    if (evidence.freed_lead) choice.note_freed(*evidence.freed_lead);
    if (evidence.by_color) choice.note_color(evidence.color_lead);
    if (evidence.by_outline && choice.by_outline()) return {*evidence.by_outline, true};
    if (evidence.by_lines) {
        choice.note_lines(evidence.lines_lead);
        if (choice.by_lines()) return {*evidence.by_lines, false};
    }
    if (evidence.by_color && choice.by_color()) return {*evidence.by_color, false, true};
    return {evidence.by_freed && choice.freed() ? *evidence.by_freed : evidence.by_picture};
}

StepEvidence exact_evidence(const StepFrame& cur, const FlowField& prev_from_cur, int spacing_px) {
    constexpr int kBorder_px = 2;
    SurfaceFitOptions fit;
    fit.spacing_px = spacing_px;
    fit.finest_px = 8;
    fit.correlation_px = 1;
    fit.noise_floor_px = 0.005f;
    const OutlineView now = cur.view();
    const Matte weights = motion_weights(now.luma, now.visible, prev_from_cur.valid, kBorder_px);
    StepEvidence out;
    out.by_picture = fit_surface_motion(prev_from_cur.d, weights, fit);
    return out;
}

}  // namespace weft
