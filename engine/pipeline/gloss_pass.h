#pragma once
#include "engine/lighting/still_surface.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// Whether a region's highlights are to be told apart by their motion, and the store does not have
/// its still surface yet.
[[nodiscard]] bool lacks_still_surface(const ShotPlan& plan, const AnalysisStore& store,
                                       int region);
/// The regions of which that is true.
[[nodiscard]] int count_gloss_steps(const ShotPlan& plan, const AnalysisStore& store);
/// Finds the still surfaces (AnalysisKind::kStillSurface, at the reference frame) from the frames
/// of RegionPlan::gloss_evidence; needs their kCoords. Errors: cancellation, and those of the
/// source and of the store.
[[nodiscard]] Status find_still_surfaces(const PassContext& context, AnalysisStore& store);
/// What was found of a region; empty where nothing was looked for or is stored yet.
[[nodiscard]] Expected<StillSurface> still_surface(const ShotPlan& plan, const AnalysisStore& store,
                                                   int region);

}  // namespace weft
