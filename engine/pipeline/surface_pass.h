#pragma once
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// Tracks the surface of every region over its span and stores what rendering needs of it:
/// coordinates (ref_from_cur), the plate's shading, the paper mode's pictures. Needs the propagated
/// mattes. Errors: those of the source and the store; cancellation.
[[nodiscard]] Status follow_surfaces(const PassContext& context, AnalysisStore& store);
/// Number of frames that follow_surfaces() visits; 0 if everything is in the store.
[[nodiscard]] int count_surface_steps(const ShotPlan& plan, const AnalysisStore& store);

/// The options of the shading estimate, with its downscale, for a plate of this size.
[[nodiscard]] ShadingOptions shading_options(const ShotPlan& plan, Size plate);

}  // namespace weft
