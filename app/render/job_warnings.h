#pragma once
#include <string>
#include <vector>

#include "app/render/render_job.h"

namespace weft {

/// Warnings about rendered frames, one line each: pixels brighter than the output can hold, NaN and
/// infinity in the plate, frames with an empty matte.
[[nodiscard]] std::vector<std::string> warnings_of(const std::vector<FrameResult>& frames);

}  // namespace weft
