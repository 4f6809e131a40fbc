#include "engine/temporal/stretch_limit.h"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(StretchLimit, LetsASmearSlideBackOverSomeFrames) {
    LatticeField field = squeezed(0.1f);
    const Matte visible(256, 128, 255);
    for (int frame = 0; frame < 12; ++frame)
        limit_stretch(field, visible);
    EXPECT_GT(slope_on_the_right(field), 0.25f);
    EXPECT_NEAR(field.at({60, 64}).x, 0, 0.5f);
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

}  // namespace
}  // namespace weft
