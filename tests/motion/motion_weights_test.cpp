#include <gtest/gtest.h>

#include "engine/motion/surface_fit.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kTexturedFrame{120, 80};

Matte textured() {
    const WaveTexture texture(4);
    return draw(kTexturedFrame, texture);
}

// The region right of x = 40, where the frame ends it on three sides.
Matte right_part() {
    Matte m(kTexturedFrame);
    for (int y = 0; y < kTexturedFrame.height; ++y)
        std::fill(m.row(y) + 40, m.row(y) + kTexturedFrame.width, 255);
    return m;
}

const Matte kAllValid(kTexturedFrame, 255);

TEST(MotionWeights, KeepAwayFromTheMattesEdgeButNotFromTheFrames) {
    const Matte w = motion_weights(textured(), right_part(), kAllValid, 6);
    for (int y = 0; y < kTexturedFrame.height; ++y) {
        for (int x = 0; x < 45; ++x)
            ASSERT_EQ(w.at(x, y), 0) << x << ", " << y;
        for (int x = 47; x < kTexturedFrame.width; ++x)
            ASSERT_GT(w.at(x, y), 0) << x << ", " << y;
    }
}

TEST(MotionWeights, CountAMatteFromHalfCoverage) {
    Matte faint(kTexturedFrame, 127), strong(kTexturedFrame, 128);
    EXPECT_EQ(motion_weights(textured(), faint, kAllValid, 2), Matte(kTexturedFrame));
    EXPECT_GT(motion_weights(textured(), strong, kAllValid, 2).at(60, 40), 0);
}

TEST(MotionWeights, AreNothingWhereTheMotionIsNotKnown) {
    Matte valid(kTexturedFrame, 255);
    valid.at(70, 30) = 0;
    const Matte w = motion_weights(textured(), right_part(), valid, 2);
    EXPECT_EQ(w.at(70, 30), 0);
    EXPECT_GT(w.at(71, 30), 0);
}

TEST(MotionWeights, TrustStructureMore) {
    Matte half_flat = textured();
    for (int y = 0; y < kTexturedFrame.height; ++y)
        std::fill(half_flat.row(y), half_flat.row(y) + 60, 128);
    const Matte w = motion_weights(half_flat, Matte(kTexturedFrame, 255), kAllValid, 2);
    EXPECT_GT(w.at(100, 40), 120);
    EXPECT_LT(w.at(20, 40), 20);
    EXPECT_GT(w.at(20, 40), 0);
}

TEST(MotionWeights, LeaveSomethingOfAThinRegion) {
    Matte thin(kTexturedFrame);
    for (int x = 0; x < kTexturedFrame.width; ++x) {
        for (int y = 40; y < 46; ++y)
            thin.at(x, y) = 255;
    }
    const Matte w = motion_weights(textured(), thin, kAllValid, 8);
    int kept = 0;
    for (int y = 0; y < kTexturedFrame.height; ++y) {
        for (int x = 0; x < kTexturedFrame.width; ++x)
            kept += w.at(x, y) > 0;
    }
    EXPECT_GE(kept, 6 * kTexturedFrame.width / 3);
}

}  // namespace
}  // namespace weft
