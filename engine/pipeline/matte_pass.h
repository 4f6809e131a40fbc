#pragma once
#include <vector>

#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// Propagates the painted mattes of every region that has keyframes over its span, forwards from
/// the keyframe before, backwards from the one after, and merges both. Keyframes stay as painted.
[[nodiscard]] Status propagate_mattes(const PassContext& context, AnalysisStore& store);
/// How many frames that will visit: 0 when everything is in the store already.
[[nodiscard]] int count_matte_steps(const ShotPlan& plan, const AnalysisStore& store);

}  // namespace weft
