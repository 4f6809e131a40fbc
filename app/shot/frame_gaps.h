#pragma once
// Frames that are missing between others, without listing the numbers of a wide gap one by one.

#include <string>
#include <vector>

#include "engine/pipeline/region_mattes.h"

namespace weft {

/// The runs of numbers within `span` that `present` (ascending) does not have, ascending. Takes
/// time and memory by the size of `present`, not of the span.
[[nodiscard]] std::vector<FrameSpan> gaps_in(const std::vector<int>& present, FrameSpan span);
/// The run without a gap around a frame; nothing outside of it, so {1, 0} when `present` has not
/// the frame itself.
[[nodiscard]] FrameSpan run_with(const std::vector<int>& present, int frame);
/// "frame 3", "frames 4-9,12"; long lists are cut.
[[nodiscard]] std::string gaps_text(const std::vector<FrameSpan>& gaps);

}  // namespace weft
