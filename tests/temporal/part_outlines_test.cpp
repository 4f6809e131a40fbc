#include "engine/temporal/part_outlines.h"

#include <gtest/gtest.h>

#include "tests/temporal/jointed_scene.h"

namespace weft {
namespace {

struct Found {
    JointedScene scene;
    PartOutlines outlines;

    Found() {
        const auto prev = scene.frame(0, nullptr), cur = scene.frame(1, prev.get());
        const FlowField flow = scene.flow(1);
        const MovingParts parts = find_moving_parts(flow, cur->view().visible);
        outlines = part_outlines(*prev, *cur, flow, parts, 8);
    }
};

TEST(PartOutlines, TheEdgeIsThePictures) {
    const Found found;
    ASSERT_EQ(found.outlines.parts.size(), 1u);
    const Matte& matte = found.outlines.parts[0].matte;
    int both = 0, either = 0;
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            const bool is = found.scene.in_arm(centre_of(x, y), 1), got = matte.at(x, y) != 0;
            both += is && got;
            either += is || got;
        }
    }
    EXPECT_GT(static_cast<double>(both) / either, 0.88);
}

// Above the arm comes to light what no motion leads to.
TEST(PartOutlines, WhatIsUncoveredIsTheBodys) {
    const Found found;
    ASSERT_EQ(found.outlines.parts.size(), 1u);
    int wrong = 0;
    for (int y = 30; y < 36; ++y) {
        for (int x = 102; x < 146; ++x)
            wrong += found.outlines.parts[0].matte.at(x, y) != 0;
    }
    EXPECT_LT(wrong, 6 * 44 / 10);
}

TEST(PartOutlines, KnowsBothMotions) {
    const Found found;
    ASSERT_EQ(found.outlines.parts.size(), 1u);
    EXPECT_LT(distance(found.outlines.parts[0].motion.at({124, 70}), {0, -JointedScene::kArm_px}),
              0.2f);
    EXPECT_LT(distance(found.outlines.body_motion.at({60, 90}), {-JointedScene::kBody_px, 0}),
              0.2f);
}

}  // namespace
}  // namespace weft
