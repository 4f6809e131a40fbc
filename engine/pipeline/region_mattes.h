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

// Those two are what the analysis follows. The picture is made with their edge tools applied:

/// holdout_matte() with the edge tools of each holdout.
[[nodiscard]] Expected<Matte> edged_holdout(const ShotSource& source, const ShotPlan& plan,
                                            const AnalysisStore& store, int region, int frame);
/// Where a region shows on a frame: its matte without its holdouts, all with their edge tools.
[[nodiscard]] Expected<Matte> shown_matte(const ShotSource& source, const ShotPlan& plan,
                                          const AnalysisStore& store, int region, int frame);
/// False if edge tools change where the region shows on this frame.
[[nodiscard]] bool shows_as_followed(const RegionPlan& region, int frame);

/// The frames that a region's analysis spans: its frames to render, references, matte keyframes
/// and the evidence of light, form, grain and, with painted mattes, focus.
struct FrameSpan {
    int first = 0, last = 0;
};
[[nodiscard]] FrameSpan analysed_span(const ShotPlan& plan, const RegionPlan& region);

}  // namespace weft
