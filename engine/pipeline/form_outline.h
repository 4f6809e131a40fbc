#pragma once
#include "engine/form/form_map.h"
#include "engine/pipeline/form_evidence.h"
#include "engine/pipeline/region_plan.h"

namespace weft {

/// The form of a region that is inflated from its outline on the reference frame (add_inflated()).
/// `extent`: the region's matte there without its holdouts, which do not end the surface.
/// `evidence`: of the reference frame. The outline is cut where the region's cut strokes lie along
/// it. Errors: Usage where the matte is too small, or turns away nowhere, or a stroke lies off its
/// outline.
[[nodiscard]] Expected<FormMap> form_from_outline(const FormEvidence& evidence, const Matte& extent,
                                                  Size plate, const RegionPlan& region);

}  // namespace weft
