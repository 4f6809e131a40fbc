#pragma once
#include "engine/pipeline/form_evidence.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// The form that the artist drew (RegionPlan::form_guides): the shape, or the plane of the parallel
/// strokes. Outside of the shape the form continues. `evidence`: of the reference frame. Errors:
/// Usage where a guide collapses, lies outside of the region or contradicts another.
[[nodiscard]] Expected<FormMap> form_from_drawing(const FormEvidence& evidence, Size plate,
                                                  const RegionPlan& region);

/// The errors of form_from_drawing() that can be known before the analysis: of regions whose matte
/// on the reference frame is given or painted. Errors: also those of the source.
[[nodiscard]] Status check_drawn_forms(const ShotSource& source, const ShotPlan& plan);

/// Turns a form by the level strokes of the region; a flat one stays. Errors: Usage where a stroke
/// lies outside of the region.
[[nodiscard]] Status level_form(const FormEvidence& evidence, const RegionPlan& region,
                                FormMap& form);

}  // namespace weft
