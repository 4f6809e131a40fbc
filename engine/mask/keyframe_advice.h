#pragma once
#include <vector>

namespace weft {

/// Confidence of one frame of a propagated matte; painted frames have 1.
struct FrameConfidence {
    int frame = 0;
    float confidence = 1;
};

/// Frames on which a painted matte would help most, best first, at most `most`. The unpainted
/// stretch with the largest total shortfall of confidence below `wanted` (0–1) comes first; the
/// suggested frame halves that shortfall. Each suggestion counts as painted before the next is
/// searched. `frames` ascend. Empty if every frame is good enough.
[[nodiscard]] std::vector<int> suggest_keyframes(std::vector<FrameConfidence> frames,
                                                 const std::vector<int>& painted,
                                                 float wanted = 0.6f, int most = 3);

}  // namespace weft
