#pragma once
#include <vector>

namespace weft {

/// Confidence of one frame of a propagated matte; painted frames have 1.
struct FrameConfidence {
    int frame = 0;
    float confidence = 1;
};

/// Frames on which a painted matte would help most, best first, at most `most`. A frame is worth as
/// much as it and its neighbours, up to the painted frames on either side, fall short of
/// `wanted`; the chosen one is where that shortfall has its middle. Each answer is taken for
/// painted before the next is looked for. `frames` ascend. Empty when every frame is good enough.
[[nodiscard]] std::vector<int> suggest_keyframes(std::vector<FrameConfidence> frames,
                                                 const std::vector<int>& painted,
                                                 float wanted = 0.6f, int most = 3);

}  // namespace weft
