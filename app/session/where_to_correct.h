#pragma once
// Suggested keyframes: the frames where a correction helps most.

#include <vector>

namespace weft {

struct FrameMarks;

struct CorrectionHint {
    enum class Kind : unsigned char {
        kMatte,   ///< Low matte confidence: paint a keyframe.
        kDrift,   ///< The surface has changed since the reference: pin the texture.
        kStretch  ///< The texture is drawn out or squeezed: another reference frame.
    };
    int frame = 0;
    Kind kind = Kind::kMatte;
    float value = 0;  ///< Confidence, drift or stretch, as in FrameMarks.
    bool operator==(const CorrectionHint&) const = default;
};

/// Up to three frames of each kind (suggest_keyframes() of engine/mask), first the one where a look
/// pays most: the best of each kind, the worst problem first, then the second ones. A frame is
/// listed once, for its worst problem. `frames` ascend and correspond to `marks`. `painted`: frames
/// with a painted matte; `anchored`: reference frames and corrections. Pure.
[[nodiscard]] std::vector<CorrectionHint> where_to_correct(const std::vector<int>& frames,
                                                           const std::vector<FrameMarks>& marks,
                                                           const std::vector<int>& painted,
                                                           const std::vector<int>& anchored);

}  // namespace weft
