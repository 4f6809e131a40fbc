#include "engine/pipeline/draft_analysis.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "engine/pipeline/analyse.h"
#include "engine/pipeline/partial_plan.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

std::vector<int> frames_in(const std::vector<int>& frames, FrameSpan span) {
    std::vector<int> inside;
    std::copy_if(frames.begin(), frames.end(), std::back_inserter(inside),
                 [&](int frame) { return frame >= span.first && frame <= span.last; });
    return inside;
}

// The keyframes that the frames of `span` are reached from soonest. In one direction of time they
// may come from far away.
std::vector<int> nearest_keys(const std::vector<int>& keys, const MatteReach& reach,
                              FrameSpan span) {
    if (reach.direction != PropagationDirection::kBoth) return keys;
    std::vector<int> inside = frames_in(keys, span);
    if (!inside.empty() || keys.empty()) return inside;
    const auto distance = [&](int key) {
        return std::min(std::abs(key - span.first), std::abs(key - span.last));
    };
    return {*std::min_element(keys.begin(), keys.end(),
                              [&](int a, int b) { return distance(a) < distance(b); })};
}

// Nothing to propagate but the region's own mattes, no light, no form, and no finish.
void keep_motion_only(RegionPlan& region) {
    leave_look_out(region);
    region.form_from = RegionPlan::FormFrom::kNothing;
    region.form_evidence.clear();
}

void shorten(RegionPlan& region, int frame) {
    const int reference = region.reference_frames.front();
    const FrameSpan span{std::min(frame, reference), std::max(frame, reference)};
    region.reference_frames = {reference};
    region.matte_keys = nearest_keys(region.matte_keys, region.matte_reach, span);
    region.matte_confirmed = frames_in(region.matte_confirmed, span);
    for (PaintedMatte& holdout : region.painted_holdouts) {
        holdout.keys = nearest_keys(holdout.keys, holdout.reach, span);
        holdout.confirmed = frames_in(holdout.confirmed, span);
    }
}

// What is in pixels of the plate.
void reduce(RegionPlan& region, int factor) {
    for (auto& [frame, pins] : region.corrections) {
        for (SurfacePin& pin : pins) {
            pin.from /= static_cast<float>(factor);
            pin.to /= static_cast<float>(factor);
        }
    }
}

}  // namespace

EarlierAnalysis DraftAnalysis::as_earlier() const {
    EarlierAnalysis out{&plan, &store, std::vector<int>(plan.regions.size())};
    std::iota(out.region_of.begin(), out.region_of.end(), 0);
    return out;
}

Expected<std::unique_ptr<DraftAnalysis>> draft_analysis(const ShotSource& source,
                                                        const ShotPlan& plan, int frame,
                                                        const std::vector<bool>& wanted,
                                                        const CancelToken& cancel) {
    const int factor = draft_factor(plan, source.size());
    auto out = std::make_unique<DraftAnalysis>(plan, factor, source.size());
    out->plan.frames = {frame};
    out->plan.quality = out->plan.motion_quality = FlowQuality::kDraft;
    for (std::size_t k = 0; k < plan.regions.size(); ++k) {
        RegionPlan& region = out->plan.regions[k];
        keep_motion_only(region);
        if (wanted[k])
            shorten(region, frame);
        else
            leave_region_out(region);
    }
    ShotPlan small = out->plan;
    for (RegionPlan& region : small.regions)
        reduce(region, factor);
    WEFT_CHECK_OK(analyse_shot(DraftSource(source, factor), small, out->store.small(), cancel, {}));
    return out;
}

}  // namespace weft
