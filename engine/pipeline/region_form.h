#pragma once
// A region's form, from what is known of the surface's shape.

#include <memory>

#include "engine/core/surface_form.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// The form of a region on its (first) reference frame; null: flat. What comes into view later
/// continues it smoothly. Errors: those of the source and the store; Unreadable if the position
/// pass shows no form there.
[[nodiscard]] Expected<std::shared_ptr<const SurfaceForm>> region_form(const ShotSource& source,
                                                                       const ShotPlan& plan,
                                                                       const AnalysisStore& store,
                                                                       int region);

}  // namespace weft
