#pragma once
// A region's form, as the analysis found it.

#include <memory>

#include "engine/core/surface_form.h"
#include "engine/form/form_on_frame.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// The form of a region as it was found, by places of its (first) reference frame; null: flat.
/// Errors: those of the store.
[[nodiscard]] Expected<std::shared_ptr<const FormMap>> found_form(const RegionPlan& region,
                                                                  const AnalysisStore& store,
                                                                  int index);

/// The same as far as the texture follows it: by the region's amount and by how far it is believed.
/// Whole where its amount has keys.
[[nodiscard]] Expected<std::shared_ptr<const SurfaceForm>> region_form(const RegionPlan& region,
                                                                       const AnalysisStore& store,
                                                                       int index);

/// What of it shows on a frame: the same, unless its amount has keys.
[[nodiscard]] std::shared_ptr<const SurfaceForm> form_on(
    const RegionPlan& region, const std::shared_ptr<const SurfaceForm>& whole, int frame);
/// What a frame shows of the scene's form over `box`, whose size `matte` has; zeros where it is
/// flat. Errors: those of the store.
[[nodiscard]] Expected<ShownForm> region_form_on(const RegionScene& scene,
                                                 const AnalysisStore& store, int index, int frame,
                                                 ViewU8x1 matte, const Recti& box);

}  // namespace weft
