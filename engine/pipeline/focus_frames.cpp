#include "engine/pipeline/focus_frames.h"

#include <algorithm>
#include <iterator>

#include "engine/composite/focus_course.h"

namespace weft {

std::vector<int> focus_grid(const RegionPlan& region) {
    const std::vector<int>& all = region.focus_frames;
    std::vector<int> out;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const bool first = k == 0 || all[k - 1] != all[k] - 1;
        const bool last = k + 1 == all.size() || all[k + 1] != all[k] + 1;
        if (first || last || all[k] % kFocusStep == 0) out.push_back(all[k]);
    }
    return out;
}

std::vector<int> needed_focus_frames(const ShotPlan& plan, const RegionPlan& region) {
    if (!(region.focus > 0)) return {};
    // Both ends of a step that is in reach in part decide whether it is read in full.
    constexpr int kReach = kFocusReach + kFocusStep - 1;
    std::vector<int> out;
    for (const int frame : focus_grid(region)) {
        const auto after = std::lower_bound(plan.frames.begin(), plan.frames.end(), frame - kReach);
        if (after != plan.frames.end() && *after <= frame + kReach) out.push_back(frame);
    }
    return out;
}

std::vector<int> focus_frames_between(const RegionPlan& region, int before, int after) {
    const std::vector<int>& all = region.focus_frames;
    return {std::upper_bound(all.begin(), all.end(), before),
            std::lower_bound(all.begin(), all.end(), after)};
}

bool focus_needs_propagation(const RegionPlan& region) {
    return region.propagated() || !region.painted_holdouts.empty() ||
           std::any_of(region.zones.begin(), region.zones.end(), [](const ZonePlan& zone) {
               return zone.kind == ZoneKind::kDetail && zone.propagated();
           });
}

}  // namespace weft
