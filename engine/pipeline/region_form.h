#pragma once
// A region's form, as the analysis found it.

#include <memory>

#include "engine/core/surface_form.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"

namespace weft {

/// The form of a region by places of its (first) reference frame; null: flat. Whole where its
/// amount has keys. Errors: those of the store.
[[nodiscard]] Expected<std::shared_ptr<const SurfaceForm>> region_form(const RegionPlan& region,
                                                                       const AnalysisStore& store,
                                                                       int index);

/// What of it shows on a frame: the same, unless its amount has keys.
[[nodiscard]] std::shared_ptr<const SurfaceForm> form_on(
    const RegionPlan& region, const std::shared_ptr<const SurfaceForm>& whole, int frame);

}  // namespace weft
