#pragma once
// How well the texture of a render lies on the surface that a position pass shows.

#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/core/cancel.h"
#include "engine/metrics/form_truth.h"

namespace weft {

/// Compares the layer `st` of the EXRs `st` with the position pass of the region on every frame,
/// inside the visible matte. The texture's proportions are those of its plane. Errors: Usage
/// without a position pass or a plane; MissingFrames when a frame has no file; Unreadable when a
/// layer is missing, a size differs, or layer or pass shows nothing of the surface; those of
/// reading; cancellation.
[[nodiscard]] Expected<FormMeasures> measure_form(const Shot& shot, const Region& region,
                                                  const std::string& st,
                                                  const std::vector<int>& frames,
                                                  const CancelToken& cancel);

}  // namespace weft
