#include "engine/pipeline/pending_mattes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/mask/scene_past.h"

namespace weft {
namespace {

constexpr Size kMatteSize{40, 20}, kPieceSize{20, 10};

PendingMatte pending(int frame, bool open = true) {
    return {frame, AnalysisKind::kMatte, {Matte(kMatteSize), 0.5f}, open};
}

// The right half.
Matte piece() {
    Matte out(kPieceSize);
    for (int y = 0; y < out.height(); ++y)
        std::fill(out.row(y) + 10, out.row(y) + 20, 255);
    return out;
}

TEST(PendingMattes, ALaterStepCompletesTheFramesBeforeIt) {
    for (const int step : {1, -1}) {
        PendingMattes mattes;
        for (int k = 0; k < 3; ++k)
            mattes.add(pending(10 + step * k, k != 1));
        mattes.complete(10 + step * 3, step, {Matte(kPieceSize), piece(), piece()});
        const auto done = mattes.take(10 + step * 3, true);
        ASSERT_EQ(done.size(), 3u);
        EXPECT_EQ(done[2].estimate.matte.at(30, 10), 0) << "nothing of the latest";
        EXPECT_EQ(done[1].estimate.matte.at(30, 10), 0) << "painted ones stay";
        EXPECT_EQ(done[0].estimate.matte.at(30, 10), 255);
        EXPECT_EQ(done[0].estimate.matte.at(10, 10), 0);
        EXPECT_EQ(done[0].estimate.confidence, 0.5f);
    }
}

TEST(PendingMattes, AreTakenInOrderWhenNoStepReachesThemAnyMore) {
    constexpr int kReach = static_cast<int>(ScenePast::kFrames);
    PendingMattes mattes;
    for (int frame = 0; frame <= kReach; ++frame)
        mattes.add(pending(frame));
    EXPECT_TRUE(mattes.take(kReach - 1, false).empty());
    const auto first = mattes.take(kReach, false);
    ASSERT_EQ(first.size(), 1u);
    EXPECT_EQ(first[0].frame, 0);
    EXPECT_EQ(mattes.take(kReach, true).size(), static_cast<std::size_t>(kReach));
}

}  // namespace
}  // namespace weft
