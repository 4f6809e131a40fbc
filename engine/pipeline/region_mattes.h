#pragma once
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// A region's full matte on a frame: from its files, or as propagated (propagate_mattes() first).
[[nodiscard]] Expected<Matte> extent_matte(const ShotSource& source, const ShotPlan& plan,
                                           const AnalysisStore& store, int region, int frame);
/// The region's holdout on a frame: the maximum of those from files and of propagated ones
/// (propagate_mattes() first); an empty image if it has none.
[[nodiscard]] Expected<Matte> holdout_matte(const ShotSource& source, const ShotPlan& plan,
                                            const AnalysisStore& store, int region, int frame);

/// The frames that a region's analysis spans: its frames to render, references, matte keyframes
/// and the evidence of light, form, grain and, with painted mattes, focus.
struct FrameSpan {
    int first = 0, last = 0;
};
[[nodiscard]] FrameSpan analysed_span(const ShotPlan& plan, const RegionPlan& region);

}  // namespace weft
