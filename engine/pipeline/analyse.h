#pragma once
#include "engine/core/progress.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// How many steps analyse_shot() would take now.
[[nodiscard]] std::int64_t count_analysis_steps(const ShotPlan& plan, const AnalysisStore& store);

/// Computes what is missing of a shot's analysis in the store: propagated mattes, coordinates,
/// shading, form, focus. A frame's results depend only on the frames between it and its references
/// and keyframes, never on which frames are requested, so different machines can analyse parts of a
/// shot. Progress: stage "analyse", one unit per visited frame. The backend may grow the textures
/// of the paper's mode faster; the results are the same. Errors: those of the source and the store;
/// cancellation.
[[nodiscard]] Status analyse_shot(const ShotSource& source, const ShotPlan& plan,
                                  AnalysisStore& store, const CancelToken& cancel,
                                  const ProgressFn& progress, const Backend* backend = nullptr);

}  // namespace weft
