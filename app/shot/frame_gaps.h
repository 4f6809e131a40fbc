#pragma once
// Gaps in frame numbers, without listing every number of a wide gap.

#include <string>
#include <vector>

#include "engine/pipeline/region_mattes.h"

namespace weft {

/// The runs of numbers within `span` that `present` (ascending) lacks, ascending. Time and memory
/// depend on the size of `present`, not of the span.
[[nodiscard]] std::vector<FrameSpan> gaps_in(const std::vector<int>& present, FrameSpan span);
/// The run without gaps around a frame; {1, 0} if `present` lacks the frame itself.
[[nodiscard]] FrameSpan run_with(const std::vector<int>& present, int frame);
/// "frame 3", "frames 4-9,12"; long lists are shortened.
[[nodiscard]] std::string gaps_text(const std::vector<FrameSpan>& gaps);

}  // namespace weft
