#include "engine/motion/held_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/core/rng.h"

namespace weft {
namespace {

constexpr Size kDrawingSize{120, 90};

struct Drawing {
    ImageU8x3 display{kDrawingSize, 200};
    Matte extent{kDrawingSize}, holdout{kDrawingSize};
    [[nodiscard]] HoldView view() const { return {display, extent, holdout}; }
};

void paint(ImageU8x3& picture, int x, int y, int r, int g, int b) {
    std::uint8_t* p = picture.pixel(x, y);
    p[0] = static_cast<std::uint8_t>(r);
    p[1] = static_cast<std::uint8_t>(g);
    p[2] = static_cast<std::uint8_t>(b);
}

// A flat box, `shift` px to the right, with one vertical ink line `line` px from its left.
Drawing drawing(double shift, double line = 30) {
    Drawing out;
    for (int y = 15; y < 75; ++y) {
        for (int x = 0; x < kDrawingSize.width; ++x) {
            const double u = x + 0.5 - 20 - shift;
            const double inside = std::min(u, 60 - u) + 0.5;
            const double alpha = std::min(1.0, std::max(0.0, inside));
            const double ink = std::min(1.0, std::max(0.0, 1.5 - std::abs(u - line)));
            if (alpha <= 0) continue;
            out.extent.at(x, y) = static_cast<std::uint8_t>(255 * alpha + 0.5);
            const double fill = (1 - ink) * 120 + ink * 25;
            const int v = static_cast<int>(alpha * fill + (1 - alpha) * 200 + 0.5);
            paint(out.display, x, y, v, v, v);
        }
    }
    return out;
}

TEST(HeldFrames, TheSameDrawingIsHeld) {
    EXPECT_TRUE(same_drawing(drawing(0).view(), drawing(0).view()));
}

TEST(HeldFrames, ALineThatMovesByATenthOfAPixelIsNot) {
    EXPECT_FALSE(same_drawing(drawing(0).view(), drawing(0, 30.1).view()));
}

TEST(HeldFrames, AFlatFillThatMovesShowsByItsOutline) {
    Drawing a = drawing(0, -50), b = drawing(0.3, -50);
    EXPECT_FALSE(same_drawing(a.view(), b.view()));
}

TEST(HeldFrames, NoiseOfACodecDoesNotEndAHold) {
    Drawing a = drawing(0), b = drawing(0);
    Rng rng(7);
    for (int y = 0; y < kDrawingSize.height; ++y)
        for (int x = 0; x < kDrawingSize.width; ++x)
            if (rng.below(4) == 0) b.display.at(x, y, 1)++;
    EXPECT_TRUE(same_drawing(a.view(), b.view()));
}

TEST(HeldFrames, BackgroundAndWhatPassesInFrontDoNotCount) {
    Drawing a = drawing(0), b = drawing(0);
    for (int y = 0; y < kDrawingSize.height; ++y) {
        for (int x = 0; x < kDrawingSize.width; ++x) {
            if (b.extent.at(x, y) == 0) paint(b.display, x, y, 20, 90, 160);
            if (x > 60 && x < 70 && y > 30 && y < 60) {
                b.holdout.at(x, y) = 255;
                paint(b.display, x, y, 255, 0, 0);
            }
        }
    }
    EXPECT_TRUE(same_drawing(a.view(), b.view()));
}

TEST(HeldFrames, ASurfaceOutOfSightIsNotHeld) {
    Drawing a = drawing(0), b = drawing(0);
    b.holdout = Matte(kDrawingSize, 255);
    EXPECT_FALSE(same_drawing(a.view(), b.view()));
    const Drawing none;
    EXPECT_FALSE(same_drawing(none.view(), none.view()));
}

TEST(HeldFrames, FindsTwosAndThrees) {
    HeldFrames held;
    std::vector<bool> found;
    for (const double shift : {0.0, 0.0, 2.0, 2.0, 2.0, 3.5, 5.0, 5.0})
        found.push_back(held.advance(drawing(shift).view()));
    EXPECT_THAT(found, testing::ElementsAre(false, true, false, true, true, false, false, true));
}

TEST(HeldFrames, SlowMovementDoesNotPassForAHold) {
    // Each step alone would be within these limits; six of them are not.
    HoldLimits wide;
    wide.block = 6;
    wide.mean = 2;
    HeldFrames held(wide);
    int moves = 0;
    for (int k = 0; k < 12; ++k)
        moves += held.advance(drawing(0, 30 + 0.1 * k).view()) ? 0 : 1;
    EXPECT_TRUE(same_drawing(drawing(0).view(), drawing(0, 30.1).view(), wide));
    EXPECT_GE(moves, 3);
}

}  // namespace
}  // namespace weft
