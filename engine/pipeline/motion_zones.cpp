#include "engine/pipeline/motion_zones.h"

#include <algorithm>
#include <utility>

#include "engine/mask/signed_distance.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/region_zones.h"
#include "engine/pipeline/surface_job.h"
#include "engine/temporal/correction.h"

namespace weft {
namespace {

bool has_motion_zones(const RegionPlan& region) {
    return region.temporal == TemporalMode::kLocked && !region.has_uv &&
           std::any_of(region.zones.begin(), region.zones.end(),
                       [](const ZonePlan& zone) { return changes_motion(zone.kind); });
}

LatticeField plus(const LatticeField& field, const LatticeField& with, const LatticeField& less) {
    LatticeField out = field;
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 change = with.node(i, j) - less.node(i, j);
            if (change != Vec2(0)) out.set_node(i, j, out.node(i, j) + change);
        }
    }
    return out;
}

// Takes the nodes of `by` at which `changed` differs from `before`.
void replace_where(LatticeField& field, const LatticeField& before, const LatticeField& changed,
                   const LatticeField& by) {
    for (int j = 0; j < field.nodes().height(); ++j)
        for (int i = 0; i < field.nodes().width(); ++i)
            if (changed.node(i, j) != before.node(i, j)) field.set_node(i, j, by.node(i, j));
}

}  // namespace

Status ZonedAnalysis::put(const AnalysisKey& /*key*/, const Bytes& /*bytes*/) {
    return fail(ErrorCode::kRenderFailed, "What is rendered from keeps no analysis.");
}

Expected<Bytes> ZonedAnalysis::get(const AnalysisKey& key) const {
    const bool track =
        key.kind == AnalysisKind::kTrackBefore || key.kind == AnalysisKind::kTrackAfter;
    const bool coords = key.kind == AnalysisKind::kCoords && key.layer == 0;
    if ((!track && !coords) || !has_motion_zones(region_of(plan_, key.region)))
        return store_.get(key);
    WEFT_TRY(placed, placed_on(key.region, key.frame));
    if (coords) return encode(placed);
    WEFT_TRY(mine, followed(key));
    WEFT_TRY(both, followed({key.region, key.frame, AnalysisKind::kCoords}));
    return encode(plus(mine, placed, both));
}

Expected<LatticeField> ZonedAnalysis::followed(const AnalysisKey& key) const {
    WEFT_TRY(bytes, store_.get(key));
    WEFT_TRY(field, decode_lattice(bytes));
    // Where parts are followed by themselves fields are finer, but not on all frames.
    const int usual =
        SurfaceTrack::spacing_for(field.full_size(), motion_of(region_of(plan_, key.region)));
    return field.spacing() < usual ? field.resampled(usual) : field;
}

Expected<LatticeField> ZonedAnalysis::placed_on(int region, int frame) const {
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = placed_.find({region, frame}); found != placed_.end())
            return found->second;
    }
    WEFT_TRY(field, followed({region, frame, AnalysisKind::kCoords}));
    WEFT_TRY(surface, extent_matte(source_, plan_, store_, region, frame));
    const RegionPlan& of = region_of(plan_, region);
    // A pin says more than a zone, and was set on what the zone shows.
    const auto pinned = of.corrections.find(frame);
    const std::vector<SurfacePin> pins =
        pinned == of.corrections.end() ? std::vector<SurfacePin>() : pinned->second;
    const LatticeField bare = recorrected(field, pins, {});
    LatticeField zoned = bare;
    for (int k = 0; k < static_cast<int>(of.zones.size()); ++k) {
        if (!changes_motion(of.zones[static_cast<std::size_t>(k)].kind)) continue;
        WEFT_TRY(changed, changed_in(region, k, frame, surface, std::move(zoned)));
        zoned = std::move(changed);
    }
    replace_where(field, bare, zoned, corrected(zoned, pins));
    const std::lock_guard lock(mutex_);
    return placed_.insert_or_assign({region, frame}, std::move(field)).first->second;
}

Expected<LatticeField> ZonedAnalysis::changed_in(int region, int zone, int frame,
                                                 const Matte& surface, LatticeField field) const {
    const ZonePlan& planned = region_of(plan_, region).zones[static_cast<std::size_t>(zone)];
    const float amount = std::clamp(planned.value_at(frame), 0.0f, 1.0f);
    if (!(amount > 0)) return field;
    WEFT_TRY(matte, zone_matte(source_, plan_, store_, region, zone, frame));
    const MotionZone acts{matte, surface, amount};
    switch (planned.kind) {
        case ZoneKind::kIgnore:
            return without_picture(field, acts);
        case ZoneKind::kStiffer:
            return stiffened(field, acts);
        case ZoneKind::kCalmer: {
            WEFT_TRY(others, frames_around(region, frame));
            return calmed(field, acts, others);
        }
        case ZoneKind::kSurroundings: {
            const AnalysisKey key{region, frame, AnalysisKind::kCoords, zone_layer(zone)};
            // Not there yet: a provisional picture.
            if (!store_.has(key)) return field;
            WEFT_TRY(around, followed(key));
            WEFT_TRY(seen, zone_surroundings(source_, plan_, store_, region, zone, frame));
            return with_surroundings(field, acts, around, seen);
        }
        case ZoneKind::kLight:
        case ZoneKind::kDetail:
            break;
    }
    return field;
}

// Those of the span within reach. All are there once the span is analysed; a provisional
// picture does with what it has.
Expected<std::vector<OtherFrame>> ZonedAnalysis::frames_around(int region, int frame) const {
    const FrameRange& span = region_of(plan_, region).calm_span;
    std::vector<OtherFrame> out;
    for (int d = -kCalm_frames; d <= kCalm_frames; ++d) {
        const AnalysisKey key{region, frame + d, AnalysisKind::kCoords};
        if (d == 0 || !span.contains(frame + d) || !store_.has(key)) continue;
        WEFT_TRY(field, followed(key));
        out.push_back({std::move(field), d});
    }
    return out;
}

Expected<Matte> zone_surroundings(const ShotSource& source, const ShotPlan& plan,
                                  const AnalysisStore& store, int region, int zone, int frame) {
    constexpr float kReach = 0.06f, kBeside_px = 1.5f;
    WEFT_TRY(matte, bare_zone_matte(source, plan, store, region, zone, frame));
    WEFT_TRY(holdout, holdout_matte(source, plan, store, region, frame));
    const float reach = kReach * static_cast<float>(matte.width());
    const ImageF1 distance = signed_distance(inside_of(matte), reach + 1);
    Matte out(matte.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const float outside = -distance.at(x, y);
            if (outside > kBeside_px && outside <= reach) out.at(x, y) = 255;
        }
    }
    return without_holdout(out, holdout);
}

}  // namespace weft
