#pragma once
#include <vector>

#include "engine/composite/focus_course.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// How many frames read_focus() will read, without those between two that differ.
[[nodiscard]] int count_focus_steps(const ShotPlan& plan, const AnalysisStore& store);

/// Reads the focus of each region on the frames that tell it for the plan's frames
/// (focus_frames.h), as far as the store lacks them. The mattes there must be propagated. A reading
/// depends on its frame alone. Errors: those of the source and of the store; cancellation.
[[nodiscard]] Status read_focus(const PassContext& context, AnalysisStore& store);

/// The reading of one frame. Errors: those of the source and of the store.
[[nodiscard]] Expected<FocusReading> focus_reading(const ShotSource& source, const ShotPlan& plan,
                                                   const AnalysisStore& store, int region,
                                                   int frame);

/// The plate's blur on a frame, from what read_focus() has stored. Errors: RenderFailed if that is
/// missing.
[[nodiscard]] Expected<FocusState> focus_on(const ShotPlan& plan, const AnalysisStore& store,
                                            int region, int frame);

}  // namespace weft
