#include "engine/temporal/outline_evidence.h"

#include <algorithm>
#include <utility>

#include "engine/core/smooth_step.h"
#include "engine/motion/contour_flow.h"
#include "engine/motion/outline_owner.h"
#include "engine/motion/outline_register.h"
#include "engine/motion/photometric_register.h"
#include "engine/motion/stripes.h"
#include "engine/motion/surface_fit.h"

namespace weft {

LatticeField outline_motion(const StepFrame& prev, const StepFrame& cur, int spacing_px) {
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

namespace {

// If the picture shows paint, going as far to the other side of its motion finds as little as the
// outline's motion does; if it shows more on the outline's side, that counts against the picture,
// unless its motion finds very much more than the outline's. `of_chance`: what is taken off where
// it does; else kOfTheFit.
double lead_of(const RegistrationPicture& before, const RegistrationPicture& now,
               const LatticeField& picture, const LatticeField& outline, double of_chance) {
    constexpr double kMostBias = 2;
    constexpr float kOtherSide = -1;  // picture + (picture - outline)
    // In correlation, in the mean over a shot: cars of plain paint gain 0.03 at most (in a single
    // step 0.06), walls, coats and a torso 0.05 to 0.4.
    constexpr float kLittle = 0.04f, kMuch = 0.1f, kFarMore = 0.2f;
    const RegistrationLead lead = registration_lead(before, now, picture, outline);
    if (lead.errors == 0) return 0;  // too little can be compared
    const auto gain = static_cast<float>(lead.gain);
    const auto far_more = static_cast<double>(smooth_step(gain, kMuch, kFarMore));
    const double beyond = lead.errors - (kOfTheFit + far_more * (of_chance - kOfTheFit));
    const float doubtful = 1.0f - smooth_step(gain, kLittle, kMuch);
    if (!(doubtful > 0)) return beyond;
    const LatticeField other_side = mix(picture, outline, kOtherSide);
    const double bias = registration_lead(before, now, outline, other_side).errors;
    return beyond - static_cast<double>(doubtful) * std::clamp(bias, 0.0, kMostBias);
}

// How much of an outline is an occluder's, as standard errors for the picture. Torsos between arms
// have 0.2 to 0.6 and a wall behind a walker 0.6 to 0.95, cars that turn 0.25 at most in the mean.
double against_outline(double occluded_share, double most) {
    constexpr double kOwn = 0.2, kForEachShare = 20;
    return std::clamp(kForEachShare * (occluded_share - kOwn), 0.0, most);
}

}  // namespace

double picture_lead(const RegistrationPicture& before, const RegistrationPicture& now,
                    const LatticeField& picture, const LatticeField& outline) {
    constexpr double kOfChance = 1;
    return lead_of(before, now, picture, outline, kOfChance);
}

namespace {

// A shade that moves over stripes takes the plate's motion along, for the stripes do not hold it,
// and finds itself again there in every frame. That motion leaves the outline behind; the one that
// is freed of light keeps to it. By how much more the plate's departs, as standard errors for the
// freed one.
double shade_lead(float plate_departs_px, float freed_departs_px, int width) {
    constexpr double kMost = 6;
    constexpr float kNone_px = 2, kClear_px = 6;  // a step, of a frame 480 wide
    const float unit = static_cast<float>(width) / 480;
    const float more = (plate_departs_px - freed_departs_px) / unit;
    return kMost * static_cast<double>(smooth_step(more, kNone_px, kClear_px));
}

// Along stripes raw motion says nothing, but follows noise, or stands still.
void add_lines(const StepFrame& prev, const StepFrame& cur, const FlowField& prev_from_cur,
               int spacing_px, StepEvidence& out) {
    const OutlineView now = cur.view();
    const Stripes stripes = stripes_of(now.luma, now.visible);
    if (!(stripes.share > 0)) return;
    const LatticeField outline = outline_motion(prev, cur, spacing_px);
    const auto occluded_by = [&](const LatticeField& picture) {
        return occluded_share(now.luma, now.extent, outline, picture, prev_from_cur, stripes.along);
    };
    // A shade confuses what an outline moves with: of a cloth under one 0 to 0.43.
    constexpr double kMostlyOwn = 0.5;
    const Stripes painted = out.by_freed ? stripes_of(cur.picture()) : Stripes{};
    if (painted.share > 0 && occluded_by(*out.by_freed) < kMostlyOwn) {
        const auto held = [&](const LatticeField& motion) {
            return along_stripes(motion, outline, now.extent, painted);
        };
        const LatticeField held_freed = held(*out.by_freed);
        *out.freed_lead +=
            shade_lead(departure(out.by_picture, held(out.by_picture), now.visible),
                       departure(*out.by_freed, held_freed, now.visible), now.visible.width());
        out.by_freed = held_where_dragged(*out.by_freed, held_freed);
    }
    const bool freed = out.by_freed && *out.freed_lead > 0;
    const LatticeField& picture = freed ? *out.by_freed : out.by_picture;
    out.by_lines = along_stripes(picture, outline, now.extent, stripes);
    // Along its lines a picture finds itself again anywhere.
    out.lines_lead = lead_of(prev.picture(), cur.picture(), picture, *out.by_lines, kOfTheFit);
    constexpr double kMostOfIt = 4;
    const double occluded = occluded_by(picture);
    if (out.lines_lead != 0) out.lines_lead += against_outline(occluded, kMostOfIt);
}

}  // namespace

void add_outline(const StepFrame& prev, const StepFrame& cur, const FlowField& prev_from_cur,
                 float structure, int spacing_px, StepEvidence& out) {
    if (structure >= kStandsOut) {
        add_lines(prev, cur, prev_from_cur, spacing_px, out);
        return;
    }
    // What is faint is found again by its own motion all the same, and by the outline's only where
    // that is right.
    out.by_outline = outline_motion(prev, cur, spacing_px);
    // Freed of light, grain is as strong as any structure, and the plate's motion is the steadier.
    constexpr double kGrain = 1;
    if (out.freed_lead) *out.freed_lead -= kGrain;
    const bool freed = out.by_freed && *out.freed_lead > 0;
    const LatticeField& picture = freed ? *out.by_freed : out.by_picture;
    out.lead = picture_lead(prev.picture(), cur.picture(), picture, *out.by_outline);
    // Where arms end what is seen of a torso, its outline moves with them.
    constexpr double kMostOfIt = 3;
    const OutlineView now = cur.view();
    const double occluded =
        occluded_share(now.luma, now.extent, *out.by_outline, picture, prev_from_cur);
    if (out.lead != 0) out.lead += against_outline(occluded, kMostOfIt);
}

OutlineEvidence::OutlineEvidence(StepEvidence of_picture, std::shared_ptr<const StepFrame> prev,
                                 std::shared_ptr<const StepFrame> cur, float structure,
                                 int spacing_px)
    : evidence_(std::move(of_picture)),
      prev_(std::move(prev)),
      cur_(std::move(cur)),
      structure_(structure),
      spacing_px_(spacing_px) {}

const StepEvidence& OutlineEvidence::whole() const {
    std::call_once(asked_, [&] {
        add_outline(*prev_, *cur_, *evidence_.raw, structure_, spacing_px_, evidence_);
    });
    return evidence_;
}

}  // namespace weft
