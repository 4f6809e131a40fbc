#include "engine/temporal/stretch_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace weft {
namespace {

// A field under which the left half stands still and the right half is squeezed to `share`.
LatticeField squeezed(float share) {
    LatticeField field({256, 128}, 8);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const float x = field.node_position(i, j).x;
            field.set_node(i, j, {x > 128 ? (share - 1) * (x - 128) : 0.0f, 0.0f});
        }
    }
    return field;
}

float slope_on_the_right(const LatticeField& field) {
    return 1 + (field.at({220, 64}).x - field.at({180, 64}).x) / 40;
}

TEST(StretchLimit, LeavesAnOrdinaryStretchAlone) {
    LatticeField field = squeezed(0.5f);
    const ImageF2 before = field.nodes();
    EXPECT_FALSE(limit_stretch(field, Matte(256, 128, 255)));
    EXPECT_EQ(field.nodes(), before);
}

TEST(StretchLimit, AsksForLessTheTighterItIs) {
    const StretchLimits tight{.drawn_out = 1.5f, .drawn_out_after = 1.2f};
    LatticeField field = squeezed(0.5f);
    EXPECT_FALSE(limit_stretch(field, Matte(256, 128, 255), StretchLimits().towards(tight, 0.5f)));
    EXPECT_TRUE(limit_stretch(field, Matte(256, 128, 255), StretchLimits().towards(tight, 1)));
    EXPECT_GT(slope_on_the_right(field), 0.55f);
}

TEST(StretchLimit, LetsASmearSlideBackOverSomeFrames) {
    LatticeField field = squeezed(0.1f);
    const Matte visible(256, 128, 255);
    for (int frame = 0; frame < 12; ++frame)
        limit_stretch(field, visible);
    EXPECT_GT(slope_on_the_right(field), 0.25f);
    EXPECT_NEAR(field.at({60, 64}).x, 0, 0.5f);
}

// What comes nearer to the camera takes its texture with it; how far is known from its size.
TEST(StretchLimit, LeavesAWholeThatGrowsAlone) {
    LatticeField field({256, 128}, 8);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i)
            field.set_node(i, j, -0.7f * field.node_position(i, j));
    }
    const Matte visible(256, 128, 255);
    LatticeField grown = field;
    EXPECT_FALSE(limit_stretch(grown, visible, {.whole = {0.25f, 1}}));
    EXPECT_TRUE(limit_stretch(grown, visible));
}

// All of it is drawn out: no part stays that the rest could be laid on.
TEST(StretchLimit, BringsAWholeThatIsDrawnOutWithinTheLimit) {
    LatticeField field({256, 128}, 8);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 p = field.node_position(i, j);
            field.set_node(i, j, {1.2f * p.x + 0.4f * p.y, -0.5f * p.y});
        }
    }
    const Matte visible(256, 128, 255);
    int frames = 0;
    while (limit_stretch(field, visible) && frames < 12)
        ++frames;
    EXPECT_GT(frames, 0);
    EXPECT_LT(frames, 12);
    const Vec2 across = Vec2(40, 0) + field.at({148, 64}) - field.at({108, 64});
    const Vec2 down = Vec2(0, 40) + field.at({128, 84}) - field.at({128, 44});
    EXPECT_LT(glm::length(across) / glm::length(down), 3.5f);
}

TEST(StretchLimit, WhatIsNotSeenDoesNotCount) {
    LatticeField field = squeezed(0.1f);
    Matte visible(256, 128);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 110; ++x)
            visible.at(x, y) = 255;
    }
    EXPECT_FALSE(limit_stretch(field, visible));
}

TEST(RelaxedStretch, LeavesALittleStretchToTheSlowWay) {
    const LatticeField field = squeezed(0.1f);
    Matte mostly_left(256, 128);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 145; ++x)
            mostly_left.at(x, y) = 255;
    }
    EXPECT_FALSE(relaxed_stretch(field, mostly_left));
    EXPECT_FALSE(relaxed_stretch(squeezed(0.5f), Matte(256, 128, 255)));
}

TEST(RelaxedStretch, NothingIsPastTheLimitAfterwards) {
    const Matte visible(256, 128, 255);
    const auto relaxed = relaxed_stretch(squeezed(0.2f), visible);
    ASSERT_TRUE(relaxed);
    EXPECT_GT(slope_on_the_right(*relaxed), 0.5f);
    LatticeField again = *relaxed;
    EXPECT_FALSE(limit_stretch(again, visible));
}

// Seen on the left, beside the horizon of a plane.
TEST(TameOutOfSight, KeepsWhatIsSeenAndBoundsTheRest) {
    LatticeField field({256, 128}, 8);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 p = field.node_position(i, j);
            field.set_node(i, j, p / (1 - p.x / 202) - p);
        }
    }
    Matte seen(256, 128);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 100; ++x)
            seen.at(x, y) = 255;
    }
    ASSERT_GT(glm::length(field.at({204, 64})), 5000);
    const LatticeField tame = tame_out_of_sight(field, seen);
    for (const Vec2 p : {Vec2(10, 10), Vec2(60, 64), Vec2(99, 120)})
        EXPECT_EQ(tame.at(p), field.at(p)) << p.x << " " << p.y;
    for (const Vec2 p : {Vec2(180, 10), Vec2(204, 64), Vec2(250, 120)})
        EXPECT_LT(glm::length(tame.at(p)), 256) << p.x << " " << p.y;
    EXPECT_EQ(tame_out_of_sight(squeezed(0.5f), seen).nodes(), squeezed(0.5f).nodes());
}

}  // namespace
}  // namespace weft
