#pragma once
#include "engine/core/progress.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// Works out whatever of a shot's analysis is not in the store yet: propagated mattes, coordinates,
/// shading. A frame's results depend on the frames between it and its references and keyframes
/// only, never on which frames are asked for, so that parts of a shot can be analysed on different
/// machines. Progress: stage "analyse", one unit a visited frame. The backend grows the textures of
/// the paper's mode faster if it can; the results are the same.
[[nodiscard]] Status analyse_shot(const ShotSource& source, const ShotPlan& plan,
                                  AnalysisStore& store, const CancelToken& cancel,
                                  const ProgressFn& progress, const Backend* backend = nullptr);

}  // namespace weft
