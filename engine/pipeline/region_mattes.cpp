#include "engine/pipeline/region_mattes.h"

#include <algorithm>

namespace weft {
namespace {

const RegionPlan& region_of(const ShotPlan& plan, int region) {
    return plan.regions[static_cast<std::size_t>(region)];
}

Matte either(Matte a, const Matte& b) {
    std::transform(b.data(), b.data() + b.size_bytes(), a.data(), a.data(),
                   [](std::uint8_t x, std::uint8_t y) { return std::max(x, y); });
    return a;
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

Expected<Matte> ShotSource::holdout_key(int /*region*/, int /*painted*/, int frame) const {
    return fail(ErrorCode::kMissingFrames,
                "No holdout is painted on frame " + std::to_string(frame) + ".");
}

Expected<Matte> holdout_matte(const ShotSource& source, const ShotPlan& plan,
                              const AnalysisStore& store, int region, int frame) {
    const RegionPlan& r = region_of(plan, region);
    Matte all;
    if (r.has_holdout) {
        WEFT_TRY(given, source.holdout(region, frame));
        if (given) all = std::move(*given);
    }
    for (int layer = 1; layer <= static_cast<int>(r.painted_holdouts.size()); ++layer) {
        WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kMatte, layer}));
        WEFT_TRY(stored, decode_matte(bytes));
        all = all.empty() ? std::move(stored.matte) : either(std::move(all), stored.matte);
    }
    return all;
}

FrameSpan analysed_span(const ShotPlan& plan, const RegionPlan& region) {
    FrameSpan span{plan.frames.front(), plan.frames.back()};
    const auto add = [&](int frame) {
        span.first = std::min(span.first, frame);
        span.last = std::max(span.last, frame);
    };
    std::for_each(region.reference_frames.begin(), region.reference_frames.end(), add);
    std::for_each(region.matte_keys.begin(), region.matte_keys.end(), add);
    for (const PaintedMatte& holdout : region.painted_holdouts)
        std::for_each(holdout.keys.begin(), holdout.keys.end(), add);
    for (const ZonePlan& zone : region.zones)
        std::for_each(zone.painted.keys.begin(), zone.painted.keys.end(), add);
    std::for_each(region.light_evidence.begin(), region.light_evidence.end(), add);
    std::for_each(region.gloss_evidence.begin(), region.gloss_evidence.end(), add);
    std::for_each(region.grain_frames.begin(), region.grain_frames.end(), add);
    std::for_each(region.form_evidence.begin(), region.form_evidence.end(), add);
    std::for_each(region.shutter_evidence.begin(), region.shutter_evidence.end(), add);
    return span;
}

}  // namespace weft
