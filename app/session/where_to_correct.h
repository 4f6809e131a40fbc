#pragma once
// The frames on which a correction would help most, and of what.

#include <vector>

namespace weft {

struct FrameMarks;

struct CorrectionHint {
    enum class Kind : unsigned char {
        kMatte,   ///< The matte is unsure: paint it there.
        kDrift,   ///< The surface looks different from the reference: pin the texture.
        kStretch  ///< The texture is drawn out or squeezed: another reference frame.
    };
    int frame = 0;
    Kind kind = Kind::kMatte;
    float value = 0;  ///< Confidence, drift or stretch there, as in FrameMarks.
    bool operator==(const CorrectionHint&) const = default;
};

/// Up to three frames of each kind (suggest_keyframes() of engine/mask), ascending; a frame is
/// named once, for what is worst. `frames` ascend and have their marks. `painted`: frames with a
/// painted matte; `anchored`: reference frames and corrections. Pure.
[[nodiscard]] std::vector<CorrectionHint> where_to_correct(const std::vector<int>& frames,
                                                           const std::vector<FrameMarks>& marks,
                                                           const std::vector<int>& painted,
                                                           const std::vector<int>& anchored);

}  // namespace weft
