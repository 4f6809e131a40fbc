#include "engine/pipeline/region_mattes.h"

#include <algorithm>

namespace weft {
namespace {

const RegionPlan& region_of(const ShotPlan& plan, int region) {
    return plan.regions[static_cast<std::size_t>(region)];
}

}  // namespace

Expected<Matte> extent_matte(const ShotSource& source, const ShotPlan& plan,
                             const AnalysisStore& store, int region, int frame) {
    const RegionPlan& r = region_of(plan, region);
    if (!r.propagated()) return source.matte(region, frame);
    WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kMatte}));
    WEFT_TRY(stored, decode_matte(bytes));
    return std::move(stored.matte);
}

Expected<Matte> holdout_matte(const ShotSource& source, const ShotPlan& plan, int region,
                              int frame) {
    if (!region_of(plan, region).has_holdout) return Matte{};
    WEFT_TRY(holdout, source.holdout(region, frame));
    return holdout ? std::move(*holdout) : Matte{};
}

FrameSpan analysed_span(const ShotPlan& plan, const RegionPlan& region) {
    FrameSpan span{plan.frames.front(), plan.frames.back()};
    const auto add = [&](int frame) {
        span.first = std::min(span.first, frame);
        span.last = std::max(span.last, frame);
    };
    std::for_each(region.reference_frames.begin(), region.reference_frames.end(), add);
    std::for_each(region.matte_keys.begin(), region.matte_keys.end(), add);
    std::for_each(region.light_evidence.begin(), region.light_evidence.end(), add);
    std::for_each(region.grain_frames.begin(), region.grain_frames.end(), add);
    std::for_each(region.shutter_evidence.begin(), region.shutter_evidence.end(), add);
    return span;
}

}  // namespace weft
