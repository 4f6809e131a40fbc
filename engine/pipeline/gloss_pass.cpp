#include "engine/pipeline/gloss_pass.h"

#include <algorithm>
#include <chrono>

#include "engine/lighting/daylight.h"
#include "engine/pipeline/plate_alpha.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

constexpr int kFinalPixel_px = 2, kDraftPixel_px = 4;
constexpr int kWidest = 1024;  // reduced pixels of a plate's side: a sequence of them fits memory

int pixel_px(const ShotPlan& plan, Size plate) {
    const int fine = plan.quality == FlowQuality::kFinal ? kFinalPixel_px : kDraftPixel_px;
    return std::max(fine, (std::max(plate.width, plate.height) + kWidest - 1) / kWidest);
}

AnalysisKey still_key(const ShotPlan& plan, int region) {
    const auto& references = plan.regions[static_cast<std::size_t>(region)].reference_frames;
    return {region, references.front(), AnalysisKind::kStillSurface};
}

Expected<StillSurface> gathered(const PassContext& context, const AnalysisStore& store,
                                int region) {
    const ShotPlan& plan = context.plan;
    const RegionPlan& of = plan.regions[static_cast<std::size_t>(region)];
    const int reference = of.reference_frames.front();
    WEFT_TRY(primary, context.source.plate(reference));
    WEFT_TRY(lit, working_plate(context.source, plan, reference, *primary));
    const Daylight daylight = find_daylight(lit);
    StillSurfaceGatherer gatherer(pixel_px(plan, context.source.size()));
    for (const int frame : of.gloss_evidence) {
        if (context.cancel.cancelled()) return cancelled(context.cancel);
        WEFT_TRY(extent, extent_matte(context.source, plan, store, region, frame));
        WEFT_TRY(holdout, holdout_matte(context.source, plan, store, region, frame));
        WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kCoords}));
        WEFT_TRY(ref_from_cur, decode_lattice(bytes));
        WEFT_TRY(plate, context.source.plate(frame));
        WEFT_TRY(working, working_plate(context.source, plan, frame, *plate));
        gatherer.add(working, without_holdout(extent, holdout), ref_from_cur);
    }
    return gatherer.finish(daylight.confidence);
}

}  // namespace

bool lacks_still_surface(const ShotPlan& plan, const AnalysisStore& store, int region) {
    return !plan.regions[static_cast<std::size_t>(region)].gloss_evidence.empty() &&
           !store.has(still_key(plan, region));
}

int count_gloss_steps(const ShotPlan& plan, const AnalysisStore& store) {
    int out = 0;
    for (int k = 0; k < static_cast<int>(plan.regions.size()); ++k)
        out += lacks_still_surface(plan, store, k);
    return out;
}

Status find_still_surfaces(const PassContext& context, AnalysisStore& store) {
    for (int k = 0; k < static_cast<int>(context.plan.regions.size()); ++k) {
        if (!lacks_still_surface(context.plan, store, k)) continue;
        const auto start = std::chrono::steady_clock::now();
        const AnalysisKey key = still_key(context.plan, k);
        WEFT_TRY(still, gathered(context, store, k));
        WEFT_CHECK_OK(store.put(key, encode(still)));
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        if (context.step) context.step(key.frame, taken.count());
    }
    return {};
}

Expected<StillSurface> still_surface(const ShotPlan& plan, const AnalysisStore& store, int region) {
    const AnalysisKey key = still_key(plan, region);
    if (plan.regions[static_cast<std::size_t>(region)].gloss_evidence.empty() || !store.has(key))
        return StillSurface();
    WEFT_TRY(bytes, store.get(key));
    return decode_still_surface(bytes);
}

}  // namespace weft
