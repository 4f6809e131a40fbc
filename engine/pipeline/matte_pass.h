#pragma once
#include <vector>

#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// Propagates the painted mattes of every region that has keyframes over its span, forwards from
/// the keyframe before, backwards from the one after, and merges both. Keyframes stay as painted.
[[nodiscard]] Status propagate_mattes(const PassContext& context, AnalysisStore& store);
/// The same for the mattes between the keyframes around `frame` only, and if that is a keyframe
/// then for those back to the keyframe before: what an artist who has painted looks at first. The
/// results are the same.
[[nodiscard]] Status propagate_mattes_at(const PassContext& context, AnalysisStore& store,
                                         int frame);
/// Number of frames that propagate_mattes() visits; 0 if everything is in the store.
[[nodiscard]] int count_matte_steps(const ShotPlan& plan, const AnalysisStore& store);

}  // namespace weft
