#pragma once
#include <memory>

#include "engine/compute/plane_pyramid.h"
#include "engine/core/surface_form.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"
#include "engine/temporal/track_seam.h"

namespace weft {

/// The seams in space and time of a region in locked mode: one for each interval between two
/// references on which the tracks do not agree (AnalysisKind::kTrackAfter), and one, outside
/// of those, after each frame on which a texture stretched past the limit was let go. They depend
/// on the texture and its form, so they are not part of the analysis. Errors: those of the source
/// and the store.
[[nodiscard]] Expected<std::vector<TrackSeam>> make_track_seams(
    const ShotSource& source, const ShotPlan& plan, const AnalysisStore& store, int region,
    const PlanePyramid& plane, const std::shared_ptr<const SurfaceForm>& form = nullptr);

}  // namespace weft
