#pragma once
#include <string>
#include <vector>

#include "app/render/render_job.h"

namespace weft {

/// What an artist should know of the frames though they were rendered: pixels brighter than the
/// output can hold, NaN and infinity in the plate, frames that no matte reaches. One line each.
[[nodiscard]] std::vector<std::string> warnings_of(const std::vector<FrameResult>& frames);

}  // namespace weft
