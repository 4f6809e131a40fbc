// A disc, and a bar that passes in front of it.
#include "engine/mask/hidden_part.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/mask/matte_propagation.h"
#include "engine/mask/signed_distance.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

using test::overlap;

constexpr int kBarStep_px = -8;  // a frame, to the left

struct Crossing : test::DiscScene {
    int bar_px = 30;

    [[nodiscard]] bool on_bar(int x, int t) const {
        const int left = 140 + t * kBarStep_px;
        return x >= left && x < left + bar_px;
    }
    [[nodiscard]] Matte bar(int t) const {
        Matte m(size);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x)
                m.at(x, y) = on_bar(x, t) ? 255 : 0;
        }
        return m;
    }
    [[nodiscard]] ImageU8x3 seen(int t) const {
        ImageU8x3 f = frame(t);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const int stripe = (x - t * kBarStep_px + 2 * y) & 15;
                for (int c = 0; c < 3 && on_bar(x, t); ++c)
                    f.at(x, y, c) = static_cast<std::uint8_t>(60 + 5 * stripe + 20 * c);
            }
        }
        return f;
    }
    [[nodiscard]] FlowField motion(int t) const {
        FlowField f = prev_from_cur(t);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                if (!on_bar(x, t)) {
                    if (on_bar(x, t - 1)) f.valid.at(x, y) = 0;
                    continue;
                }
                f.d.at(x, y, 0) = -kBarStep_px;
                f.d.at(x, y, 1) = 0;
                f.valid.at(x, y) = 255;
            }
        }
        return f;
    }
};

// The least overlap of the disc's matte with all of the disc, and that on the last frame.
struct Kept {
    double least = 1, last = 0;
};

Kept walk_crossing(const Crossing& scene, bool knows_bar) {
    Kept kept;
    MatteWalker walker(scene.seen(0), scene.matte(0), {}, scene.bar(0));
    for (int t = 1; t <= 20; ++t) {
        const Matte bar = knows_bar ? scene.bar(t) : Matte();
        kept.last =
            overlap(walker.advance(scene.seen(t), scene.motion(t), bar).matte, scene.matte(t));
        kept.least = std::min(kept.least, kept.last);
    }
    return kept;
}

TEST(HiddenPart, StaysHiddenWhenTheBoundaryMoves) {
    ImageF1 seen(3, 1), phi(3, 1, -2.0f), none;
    seen.at(0, 0) = 4;
    move_seen(seen, phi);
    EXPECT_EQ(seen.at(0, 0), -2);
    EXPECT_EQ(seen.at(1, 0), 0);
    move_seen(none, phi);
    EXPECT_TRUE(none.empty());
}

TEST(HiddenPart, ASurfaceStaysWholeBehindWhatPasses) {
    const Crossing scene;
    const Kept knowing = walk_crossing(scene, true), unknowing = walk_crossing(scene, false);
    EXPECT_GT(knowing.least, 0.94);
    EXPECT_GT(knowing.last, 0.96);
    EXPECT_LT(unknowing.least, 0.9);
}

TEST(HiddenPart, WhatIsHiddenAltogetherWaitsOnTheBackground) {
    Crossing scene;
    scene.step = Vec2(0);
    scene.bar_px = 70;
    const Kept knowing = walk_crossing(scene, true), unknowing = walk_crossing(scene, false);
    EXPECT_GT(knowing.least, 0.9);
    EXPECT_GT(knowing.last, 0.94);
    EXPECT_LT(unknowing.least, 0.5);
}

TEST(HiddenPart, IsGrownByAPixelAndEmptyIfNothingIsInFront) {
    Matte front(20, 10);
    EXPECT_TRUE(hidden_part(front).empty());
    EXPECT_TRUE(hidden_part({}).empty());
    front.at(8, 4) = 255;
    const Matte hidden = hidden_part(front);
    for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 20; ++x)
            EXPECT_EQ(hidden.at(x, y) != 0, (Recti{7, 3, 10, 6}.contains(x, y))) << x << ", " << y;
    }
}

TEST(HiddenPart, MovesAsWhatIsSeenOrAsTheBackground) {
    Crossing scene;
    constexpr int kFrame = 8;  // the bar covers the disc's right side
    const ImageF1 phi = signed_distance(inside_of(scene.matte(kFrame - 1)), 40);
    const Matte hidden = hidden_part(scene.bar(kFrame));
    const FlowField behind = motion_behind(scene.motion(kFrame), hidden, phi, 10);
    const Vec2i in_disc(static_cast<int>(scene.center(kFrame).x) + 22, 62);
    ASSERT_TRUE(hidden.at(in_disc.x, in_disc.y));
    EXPECT_NEAR(behind.d.at(in_disc.x, in_disc.y, 0), -scene.step.x, 0.2);
    EXPECT_NEAR(behind.d.at(in_disc.x, in_disc.y, 1), -scene.step.y, 0.2);
    EXPECT_EQ(behind.valid.at(in_disc.x, in_disc.y), 0);

    scene.bar_px = 70;
    constexpr int kAllHidden = 13;
    const ImageF1 before = signed_distance(inside_of(scene.matte(kAllHidden - 1)), 40);
    const FlowField waiting =
        motion_behind(scene.motion(kAllHidden), hidden_part(scene.bar(kAllHidden)), before, 10);
    const auto x = static_cast<int>(scene.center(kAllHidden).x);
    EXPECT_NEAR(waiting.d.at(x, 62, 0), 0, 0.1);
    EXPECT_NEAR(waiting.d.at(x, 62, 1), 0, 0.1);
    EXPECT_EQ(waiting.valid.at(x, 62), 255);
}

}  // namespace
}  // namespace weft
