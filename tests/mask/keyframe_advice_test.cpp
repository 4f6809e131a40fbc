#include "engine/mask/keyframe_advice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

std::vector<FrameConfidence> falling_from(int key, int count, float a_frame) {
    std::vector<FrameConfidence> frames;
    for (int f = 0; f < count; ++f) {
        frames.push_back({f, std::exp(-a_frame * static_cast<float>(std::abs(f - key)))});
    }
    return frames;
}

TEST(SuggestKeyframes, NothingWhereAllIsWell) {
    EXPECT_TRUE(suggest_keyframes(falling_from(0, 40, 0.005f), {0}).empty());
}

TEST(SuggestKeyframes, LiesInTheWorstStretchAwayFromWhatIsPainted) {
    const auto advice = suggest_keyframes(falling_from(0, 60, 0.04f), {0}, 0.6f, 1);
    ASSERT_EQ(advice.size(), 1u);
    EXPECT_GT(advice[0], 30);
    EXPECT_LT(advice[0], 58);  // not the very end, of which it would help one side only
}

TEST(SuggestKeyframes, FurtherOnesKeepAwayFromEachOtherAndFromPaintedFrames) {
    const std::vector<int> painted{20};
    const auto advice = suggest_keyframes(falling_from(20, 120, 0.05f), painted, 0.6f, 3);
    ASSERT_EQ(advice.size(), 3u);
    for (std::size_t i = 0; i < advice.size(); ++i) {
        EXPECT_GT(std::abs(advice[i] - 20), 8);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GT(std::abs(advice[i] - advice[j]), 8);
    }
}

}  // namespace
}  // namespace weft
