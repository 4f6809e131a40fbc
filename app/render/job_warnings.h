#pragma once
#include <string>
#include <vector>

#include "app/render/render_job.h"

namespace weft {

/// That what is kept of a region's highlights may be bright paint.
[[nodiscard]] std::string unsure_highlights_text(const std::string& region);

/// Warnings about rendered frames, one line each: pixels that the artist's own settings made
/// brighter than the output can hold, NaN and infinity in the plate, frames with an empty matte.
[[nodiscard]] std::vector<std::string> warnings_of(const std::vector<FrameResult>& frames,
                                                   const Project& project);

}  // namespace weft
