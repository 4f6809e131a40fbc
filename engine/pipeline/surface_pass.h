#pragma once
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// Follows the surface of every region over its span and keeps what rendering needs of it:
/// coordinates (ref_from_cur), the plate's shading, the paper mode's pictures. The mattes must have
/// been propagated.
[[nodiscard]] Status follow_surfaces(const PassContext& context, AnalysisStore& store);
/// How many frames that will visit: 0 when everything is in the store already.
[[nodiscard]] int count_surface_steps(const ShotPlan& plan, const AnalysisStore& store);

/// At which fraction of the plate's size the shading is estimated.
[[nodiscard]] ShadingOptions shading_options(const ShotPlan& plan, Size plate);

}  // namespace weft
