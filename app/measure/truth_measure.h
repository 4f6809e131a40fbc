#pragma once
// Compares a result with the scene rendered with the new material.

#include <string>
#include <vector>

#include "app/measure/measure_job.h"
#include "engine/core/cancel.h"
#include "engine/metrics/truth.h"

namespace weft {

/// Compares `result` with the frames of `frames` that `truth` has, after one overall gain. Errors:
/// MissingFrames when it has none of them; Unreadable when a size differs; those of reading;
/// cancellation.
[[nodiscard]] Expected<TruthMeasures> measure_truth(const Shot& shot, const ResultReader& result,
                                                    const ResultReader& truth,
                                                    const std::vector<int>& frames, float blur_px,
                                                    const CancelToken& cancel);

}  // namespace weft
