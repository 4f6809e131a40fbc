#include "engine/pipeline/region_mattes.h"

#include <algorithm>

#include "engine/pipeline/focus_frames.h"
#include "engine/pipeline/plate_views.h"
#include "engine/temporal/zone_motion.h"

namespace weft {
namespace {

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

Expected<ConfirmedPart> ShotSource::confirmed_part(int /*region*/, int /*layer*/, int frame) const {
    return fail(ErrorCode::kMissingFrames,
                "No part of a matte is confirmed on frame " + std::to_string(frame) + ".");
}

Expected<Matte> ShotSource::given_holdout(int region, int /*given*/, int frame) const {
    WEFT_TRY(all, holdout(region, frame));
    if (all) return std::move(*all);
    return fail(ErrorCode::kMissingFrames,
                "There is no holdout on frame " + std::to_string(frame) + ".");
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

Expected<Matte> edged_holdout(const ShotSource& source, const ShotPlan& plan,
                              const AnalysisStore& store, int region, int frame) {
    const RegionPlan& r = region_of(plan, region);
    Matte all;
    const auto add = [&](Matte matte, const MatteEdgePlan& edge) {
        matte = with_edge(std::move(matte), edge.at(frame));
        all = all.empty() ? std::move(matte) : either(std::move(all), matte);
    };
    const auto none = [](const MatteEdgePlan& edge) { return edge.none(); };
    const auto& given = r.given_holdout_edges;
    if (r.has_holdout && std::all_of(given.begin(), given.end(), none)) {
        WEFT_TRY(matte, source.holdout(region, frame));
        if (matte) all = std::move(*matte);
    } else if (r.has_holdout) {
        for (int k = 0; k < static_cast<int>(given.size()); ++k) {
            WEFT_TRY(matte, source.given_holdout(region, k, frame));
            add(std::move(matte), given[static_cast<std::size_t>(k)]);
        }
    }
    for (int layer = 1; layer <= static_cast<int>(r.painted_holdouts.size()); ++layer) {
        WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kMatte, layer}));
        WEFT_TRY(stored, decode_matte(bytes));
        add(std::move(stored.matte), r.painted_holdouts[static_cast<std::size_t>(layer - 1)].edge);
    }
    return all;
}

Expected<Matte> shown_matte(const ShotSource& source, const ShotPlan& plan,
                            const AnalysisStore& store, int region, int frame) {
    WEFT_TRY(extent, extent_matte(source, plan, store, region, frame));
    WEFT_TRY(holdout, edged_holdout(source, plan, store, region, frame));
    return without_holdout(
        with_edge(std::move(extent), region_of(plan, region).matte_edge.at(frame)), holdout);
}

bool shows_as_followed(const RegionPlan& region, int frame) {
    const auto none = [&](const MatteEdgePlan& edge) { return edge.at(frame).none(); };
    return none(region.matte_edge) &&
           std::all_of(region.given_holdout_edges.begin(), region.given_holdout_edges.end(),
                       none) &&
           std::all_of(region.painted_holdouts.begin(), region.painted_holdouts.end(),
                       [&](const PaintedMatte& holdout) { return none(holdout.edge); });
}

FrameSpan analysed_span(const ShotPlan& plan, const RegionPlan& region) {
    FrameSpan span{plan.frames.front(), plan.frames.back()};
    const auto add = [&](int frame) {
        span.first = std::min(span.first, frame);
        span.last = std::max(span.last, frame);
    };
    if (!region.calm_span.empty()) {
        const FrameRange& run = region.calm_span;
        add(std::max(span.first - kCalm_frames, std::min(run.begin, span.first)));
        add(std::min(span.last + kCalm_frames, std::max(run.end - 1, span.last)));
    }
    std::for_each(region.reference_frames.begin(), region.reference_frames.end(), add);
    const auto add_all = [&](const std::vector<int>& frames) {
        std::for_each(frames.begin(), frames.end(), add);
    };
    add_all(region.matte_keys);
    add_all(region.matte_confirmed);
    for (const PaintedMatte& holdout : region.painted_holdouts) {
        add_all(holdout.keys);
        add_all(holdout.confirmed);
    }
    for (const ZonePlan& zone : region.zones) {
        add_all(zone.painted.keys);
        add_all(zone.painted.confirmed);
    }
    if (region.light_frame && (region.estimates_light() || region.match > 0))
        add(*region.light_frame);
    std::for_each(region.light_evidence.begin(), region.light_evidence.end(), add);
    std::for_each(region.gloss_evidence.begin(), region.gloss_evidence.end(), add);
    std::for_each(region.grain_frames.begin(), region.grain_frames.end(), add);
    std::for_each(region.form_evidence.begin(), region.form_evidence.end(), add);
    std::for_each(region.shutter_evidence.begin(), region.shutter_evidence.end(), add);
    if (focus_needs_propagation(region)) {
        const std::vector<int> focus = needed_focus_frames(plan, region);
        std::for_each(focus.begin(), focus.end(), add);
    }
    return span;
}

}  // namespace weft
