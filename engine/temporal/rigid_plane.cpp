#include "engine/temporal/rigid_plane.h"

#include <algorithm>
#include <utility>

namespace weft {
namespace {

// Whether what bends explains so much more than the plane that it is more than noise and lens. On
// planes filmed by hand it explains up to a sixth of what the plane leaves, and 0.02 in
// correlation; on a swan a quarter and more from the fourth frame on, on a ball and waving cloth
// half of it from the first.
bool bends(const RegistrationPicture& there, const RegistrationPicture& here,
           const LatticeField& plane, const LatticeField& bent) {
    constexpr double kSure = 3, kMuch = 0.04, kMuchOfTheRest = 0.25;  // errors, correlation, share
    constexpr double kOfOthers = 0.1;  // of the surface: what passes in front, and is in the matte
    const RegistrationLead lead = registration_lead(there, here, bent, plane, kOfOthers);
    if (lead.errors < kSure) return false;
    const double unexplained = 1 - registration_agreement(there, here, plane);
    return lead.gain > std::min(kMuch, kMuchOfTheRest * unexplained);
}

}  // namespace

RigidPlane::RigidPlane(SurfaceKind kind)
    : believed_(may_be_plane(kind)), said_(kind == SurfaceKind::kPlane) {}

bool RigidPlane::is_borne_out() const {
    constexpr int kFrames = 6;
    return borne_out_ >= kFrames;
}

bool RigidPlane::may_be_taken_for_granted() const {
    constexpr int kEvery = 4;
    return believed_ && is_borne_out() && against_ == 0 && granted_ + 1 < kEvery;
}

std::optional<Registered> RigidPlane::taken_for_granted(const Anchor& anchor, const StepFrame& cur,
                                                        bool by_color, const LatticeField& initial,
                                                        FlowQuality quality) {
    constexpr double kMoreResidual = 1.1, kLessShare = 0.9;
    const RegisteredPictures pictures = pictures_of(anchor, cur, by_color);
    const RegistrationOptions options = planar_options(quality);
    PlanarRegistration plane = register_planar(pictures.there, pictures.here, initial, options);
    if (!plane.found || !shows_surface(plane.fit) ||
        plane.fit.residual > kMoreResidual * asked_.residual ||
        plane.fit.share < kLessShare * asked_.share)
        return std::nullopt;
    ++granted_;
    return Registered{refine_planar(pictures.there, pictures.here, plane.anchor_from_cur, options),
                      plane.fit, true};
}

void RigidPlane::note(bool speaks_against, const RegistrationFit& fit) {
    constexpr double kRefuted = 2, kForgotten = 0.5;
    granted_ = 0;
    // A frame that shows nothing says nothing for it either, nor how well others have to do.
    if (shows_surface(fit)) {
        asked_ = fit;
        if (!speaks_against) ++borne_out_;
    }
    against_ = speaks_against ? against_ + 1 : std::max(0.0, against_ - kForgotten);
    if (against_ >= kRefuted && !said_) believed_ = false;
}

std::optional<Registered> RigidPlane::registered(const Anchor& anchor, const StepFrame& cur,
                                                 bool by_color, const LatticeField& initial,
                                                 const Registered& bent, FlowQuality quality) {
    if (!believed_) return std::nullopt;
    if (bent.planar) {
        note(false, bent.fit);
        return bent;
    }
    const RegisteredPictures pictures = pictures_of(anchor, cur, by_color);
    const RegistrationPicture &there = pictures.there, &here = pictures.here;
    const RegistrationOptions options = planar_options(quality);
    PlanarRegistration plane = register_planar(there, here, initial, options);
    if (!plane.found) plane.fit = registration_fit(there, here, initial, options);
    const bool speaks_against = bends(there, here, plane.anchor_from_cur, bent.anchor_from_cur);
    note(speaks_against, plane.fit);
    if (!said_ && (!believed_ || speaks_against)) return std::nullopt;
    if (plane.found) {
        plane.anchor_from_cur = refine_planar(there, here, plane.anchor_from_cur, options);
    }
    return Registered{std::move(plane.anchor_from_cur), plane.fit, true};
}

}  // namespace weft
