#pragma once
// A region's form, as the analysis found it.

#include <memory>

#include "engine/core/surface_form.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"

namespace weft {

/// The form of a region by places of its (first) reference frame; null: flat. Errors: those of the
/// store.
[[nodiscard]] Expected<std::shared_ptr<const SurfaceForm>> region_form(const RegionPlan& region,
                                                                       const AnalysisStore& store,
                                                                       int index);

}  // namespace weft
