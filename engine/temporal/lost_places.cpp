#include "engine/temporal/lost_places.h"

#include <algorithm>

#include "engine/motion/stripes.h"
#include "engine/motion/wide_search.h"

namespace weft {
namespace {

struct Candidate {
    Registered registered;
    double known_share = 0;
};

// Along stripes shades are found again wherever they have gone.
Candidate search(const Anchor& anchor, const StepFrame& cur, const RegisteredPictures& seen,
                 FoundBy by, const Registered& found, MissedBy missed, FlowQuality quality) {
    const WideSearch wide =
        search_around({seen.there, anchor.frame->view().visible}, {seen.here, cur.view().visible},
                      seen.luma, found.anchor_from_cur, missed, quality);
    const LatticeField initial =
        by.freed ? changed_across_stripes(wide.anchor_from_cur, found.anchor_from_cur,
                                          stripes_of(seen.there))
                 : wide.anchor_from_cur;
    return {register_against(anchor, cur, by.color, initial, quality), wide.known_share};
}

// Whether a candidate is the same paint. Shades that move over a faint surface are found again,
// too: they take a smooth field along, and leave more than noise since other shades are gone. A
// part alone follows a fold's shading as easily, so it has to explain more.
bool convinces(const Candidate& candidate, MissedBy missed, const Registered& before,
               double noise) {
    constexpr double kKnown = 0.3, kShareLost = 0.02;
    constexpr double kAsNoise = 1.35, kExplained = 0.35, kExplainedByParts = 0.4;
    constexpr double kExplainedByBending = 0.5;
    const Registered& now = candidate.registered;
    if (candidate.known_share < kKnown || now.fit.share < before.fit.share - kShareLost)
        return false;
    const double left = before.fit.residual - noise;
    const double explained = (before.fit.residual - now.fit.residual) / left;
    // What was a plane does not bend without reason.
    if (before.planar && !now.planar && explained < kExplainedByBending) return false;
    if (missed == MissedBy::kParts) return explained > kExplainedByParts;
    return explained > kExplained || (explained > 0 && now.fit.residual < kAsNoise * noise);
}

}  // namespace

void LostPlaces::note(const RegistrationFit& step) {
    constexpr std::size_t kKept = 8;
    if (steps_.size() == kKept) steps_.erase(steps_.begin());
    steps_.push_back(step.residual);
}

// A step that itself missed leaves more than the noise. Pictures without any, as of a camera that
// stands still in computed animation, leave what rounding to codes does.
double LostPlaces::noise() const {
    constexpr double kOfRounding = 0.01;
    return steps_.empty() ? 1
                          : std::max(kOfRounding, *std::min_element(steps_.begin(), steps_.end()));
}

std::optional<Registered> LostPlaces::find(const Anchor& anchor, const StepFrame& cur, FoundBy by,
                                           const Registered& found, FlowQuality quality) {
    constexpr double kLittle = 1.05;       // of the noise
    constexpr double kAnyStructure = 0.3;  // in correlation; less is grain
    constexpr double kPlaneAlone = 1.5;    // of the noise: planes do not lose parts
    constexpr int kLongestWait = 3;
    const double noise = this->noise();
    const double little = found.planar ? kPlaneAlone : kLittle;
    if (found.fit.residual < little * noise || --waiting_ > 0) return std::nullopt;
    const RegisteredPictures seen = pictures_of(anchor, cur, by.color);
    if (registration_agreement(seen.there, seen.here, found.anchor_from_cur) < kAnyStructure)
        return std::nullopt;
    std::optional<Registered> best;
    for (const MissedBy missed : {MissedBy::kSurface, MissedBy::kParts, MissedBy::kSurface}) {
        const Registered& before = best ? *best : found;
        if (before.fit.residual < kLittle * noise) break;
        Candidate wider = search(anchor, cur, seen, by, before, missed, quality);
        if (!convinces(wider, missed, before, noise)) continue;
        const LatticeField& now = wider.registered.anchor_from_cur;
        if (registration_lead(seen.there, seen.here, now, before.anchor_from_cur).errors > 0)
            best = std::move(wider.registered);
    }
    in_vain_ = best ? 0 : std::min(in_vain_ + 1, kLongestWait);
    waiting_ = 1 + in_vain_;
    return best;
}

}  // namespace weft
