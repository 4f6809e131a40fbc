#include "engine/mask/newcomers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr Size kTwinFrame{140, 90};
constexpr int kStep_px = 4, kFrames = 8;
constexpr Vec2i kOnSurface{100, 45}, kOnTwin{52, 45};

// A pattern that nothing repeats near by, of 8-bit levels.
std::uint8_t pattern(int x, int y) {
    const auto u = static_cast<float>(x), v = static_cast<float>(y);
    const float wave = std::sin(0.9f * u + 0.3f * v) + std::sin(0.31f * u - 0.8f * v);
    return static_cast<std::uint8_t>(std::lround(128 + 40 * wave));
}

// A surface moves to the right and uncovers another thing of its kind, which the matte takes in as
// it comes into view.
struct TwinWorld {
    bool plain = false;      // neither shows anything
    bool turns = false;      // what comes into view is more of the surface itself
    int step_px = kStep_px;  // of the surface, a frame
    Newcomers newcomers = {};
    ImageF1 odds = {};  // of the last frame

    [[nodiscard]] int left(int t) const { return 40 + t * step_px; }  // of the surface
    [[nodiscard]] int motion_of_twin() const { return turns ? step_px : 0; }
    // The matte's left end: where the surface was at first, or what has turned into view.
    [[nodiscard]] int matte_left(int t) const { return 40 + t * (turns ? step_px - 3 : 0); }

    [[nodiscard]] ImageU8x3 frame(int t) const {
        ImageU8x3 out(kTwinFrame);
        for (int y = 0; y < kTwinFrame.height; ++y) {
            for (int x = 0; x < kTwinFrame.width; ++x) {
                const int moved = x >= left(t) ? step_px : motion_of_twin();
                const std::uint8_t level = plain ? std::uint8_t{128} : pattern(x - t * moved, y);
                std::fill_n(out.pixel(x, y), 3, level);
            }
        }
        return out;
    }
    [[nodiscard]] ImageF1 phi(int t) const {
        ImageF1 out(kTwinFrame);
        for (int y = 0; y < kTwinFrame.height; ++y)
            for (int x = 0; x < kTwinFrame.width; ++x)
                out.at(x, y) = static_cast<float>(std::clamp(x - matte_left(t), -40, 40));
        return out;
    }
    void advance(int t) {
        const ImageU8x3 now = frame(t), before = frame(t - 1);
        const ImageF1 prev_phi = phi(t - 1), found = phi(t);
        FlowField flow(kTwinFrame);
        ImageF2 outside(kTwinFrame);
        ImageF1 expected(kTwinFrame);
        Matte appearing(kTwinFrame);
        for (int y = 0; y < kTwinFrame.height; ++y) {
            for (int x = 0; x < kTwinFrame.width; ++x) {
                const bool covered_before = x >= left(t - 1) && x < left(t) && !turns;
                appearing.at(x, y) = covered_before ? 255 : 0;
                flow.valid.at(x, y) = covered_before ? 0 : 255;
                flow.d.at(x, y, 0) =
                    static_cast<float>(x >= left(t) ? -step_px : -motion_of_twin());
                expected.at(x, y) = static_cast<float>(x - matte_left(t - 1) - step_px);
            }
        }
        odds = newcomers.advance(
            {now, before, prev_phi, flow, outside, appearing, expected, rect_of(kTwinFrame), 1});
        newcomers.settle(found);
    }
    void run() {
        for (int t = 1; t <= kFrames; ++t)
            advance(t);
    }
    [[nodiscard]] float least() const {
        float out = 0;
        for (int y = 0; y < kTwinFrame.height; ++y)
            out = std::min(out, *std::min_element(odds.row(y), odds.row(y) + kTwinFrame.width));
        return out;
    }
};

TEST(Newcomers, WhatIsUncoveredAndStaysBehindIsDoubted) {
    TwinWorld w;
    w.run();
    EXPECT_LT(w.odds.at(kOnTwin.x, kOnTwin.y), -1);
    EXPECT_EQ(w.odds.at(kOnSurface.x, kOnSurface.y), 0);
    EXPECT_LT(w.odds.at(w.left(kFrames) - 2, 45), -1) << "what has just come is as doubtful";
}

TEST(Newcomers, AStripIsNot) {
    TwinWorld w;
    for (int t = 1; t <= 3; ++t) {
        w.advance(t);
        EXPECT_EQ(w.least(), 0) << t;
    }
}

TEST(Newcomers, WhatTurnsIntoViewBelongsToTheSurface) {
    TwinWorld w;
    w.turns = true;
    for (int t = 1; t <= kFrames; ++t) {
        w.advance(t);
        EXPECT_EQ(w.least(), 0) << t;
    }
}

TEST(Newcomers, APlainPictureSaysNothing) {
    TwinWorld w;
    w.plain = true;
    w.run();
    EXPECT_EQ(w.least(), 0);
}

TEST(Newcomers, NothingIsSaidWhereBothStandStill) {
    TwinWorld w;
    w.run();
    ASSERT_LT(w.least(), -1);
    TwinWorld still;
    still.step_px = 0;
    still.run();
    EXPECT_EQ(still.least(), 0);
}

TEST(Newcomers, KnowWhatCameFromOutside) {
    Newcomers fresh;
    EXPECT_TRUE(fresh.entered().empty());
    const ImageU8x3 picture = TwinWorld().frame(0);
    ImageF1 before(kTwinFrame, -9.0f), now(kTwinFrame, -9.0f), expected(kTwinFrame, -9.0f);
    for (int y = 30; y < 60; ++y) {
        for (int x = 30; x < 60; ++x)
            now.at(x, y) = 5;
    }
    const FlowField still(kTwinFrame);
    const ImageF2 outside(kTwinFrame);
    const Matte appearing(kTwinFrame);
    (void)fresh.advance(
        {picture, picture, before, still, outside, appearing, expected, rect_of(kTwinFrame), 1});
    fresh.settle(now);
    EXPECT_NE(fresh.entered().at(45, 45), 0);
    EXPECT_EQ(fresh.entered().at(10, 10), 0) << "it is not inside";
    // And stays one, when it has been inside.
    (void)fresh.advance(
        {picture, picture, now, still, outside, appearing, now, rect_of(kTwinFrame), 1});
    fresh.settle(now);
    EXPECT_NE(fresh.entered().at(45, 45), 0);
}

// As a camera that zooms out or turns shows more of a wall behind posts.
TEST(Newcomers, WhatComesIntoThePictureHasNotEntered) {
    const ImageU8x3 picture = TwinWorld().frame(0);
    ImageF1 before(kTwinFrame, -9.0f), now(kTwinFrame, -9.0f);
    for (int y = 0; y < kTwinFrame.height; ++y) {
        for (int x = 0; x < 20; ++x)
            now.at(x, y) = 5;
    }
    FlowField from_outside(kTwinFrame);
    for (int y = 0; y < kTwinFrame.height; ++y) {
        for (int x = 0; x < kTwinFrame.width; ++x)
            from_outside.d.at(x, y, 0) = -20;
    }
    Newcomers newcomers;
    (void)newcomers.advance({picture, picture, before, from_outside, ImageF2(kTwinFrame),
                             Matte(kTwinFrame), now, rect_of(kTwinFrame), 1});
    newcomers.settle(now);
    EXPECT_EQ(newcomers.entered().at(10, 45), 0);
}

}  // namespace
}  // namespace weft
