#pragma once
// The lens that the regions of a shot have in common. Internal to the folder.

#include "engine/pipeline/form_motion.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// What the motion of all regions that share the lens (RegionPlan::shares_lens()) says of it
/// together (shared_tangent()).
/// Without `shared` if they are fewer than two, say nothing or contradict each other. Needs mattes
/// and kCoords of their evidence. Errors: those of the source and the store; cancellation.
[[nodiscard]] Expected<MotionLens> shared_lens(const PassContext& context,
                                               const AnalysisStore& store);

}  // namespace weft
