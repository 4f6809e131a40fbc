// A wall that pans, painted loosely around somebody who jumps in front of it.
#include "engine/mask/painted_sides.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "engine/mask/matte_propagation.h"

namespace weft {
namespace {

constexpr Size kPaintedFrame{320, 200};
constexpr float kPaintedUnit_px = 320.0f / 854;
constexpr Recti kPaintedWall{60, 10, 310, 190};  // of the painted frame
constexpr Recti kSomebody{40, 60, 90, 130};
constexpr Vec2i kWallStep{2, 0}, kJumpStep{1, -9};  // px to the next frame

using PaintedRgb = std::array<std::uint8_t, 3>;

// Soft stripes, and soft mottles so that motion can be told.
PaintedRgb painted_wall_color(int x, int y) {
    const auto code = static_cast<std::uint8_t>(
        205 + std::lround(5 * std::sin(0.25 * x) + 4 * std::sin(0.19 * y + 0.1 * x)));
    return {code, static_cast<std::uint8_t>(code - 4), code};
}
PaintedRgb somebody_color(int x, int y) {
    const auto code = static_cast<std::uint8_t>(120 + std::lround(4 * std::sin(0.3 * (x + y))));
    return {code, static_cast<std::uint8_t>(code - 40), static_cast<std::uint8_t>(code - 60)};
}

class PaintedSides : public ::testing::Test {
  protected:
    // `somebody` jumps in front of the wall, `step` (0 or 1) frames after the painted one.
    ImageU8x3 frame(int step) const {
        ImageU8x3 out(kPaintedFrame);
        for (int y = 0; y < kPaintedFrame.height; ++y) {
            for (int x = 0; x < kPaintedFrame.width; ++x) {
                const Vec2i s = Vec2i(x, y) - step * kJumpStep, w = Vec2i(x, y) - step * kWallStep;
                const PaintedRgb color =
                    somebody_.contains(s.x, s.y) ? paint_(s.x, s.y) : painted_wall_color(w.x, w.y);
                std::copy(color.begin(), color.end(), out.pixel(x, y));
            }
        }
        return out;
    }
    FlowField motion() const {
        FlowField out(kPaintedFrame);
        for (int y = 0; y < kPaintedFrame.height; ++y) {
            for (int x = 0; x < kPaintedFrame.width; ++x) {
                const Vec2i s = Vec2i(x, y) - kJumpStep;
                Vec2 d = somebody_.contains(s.x, s.y) ? -Vec2(kJumpStep) : -Vec2(kWallStep);
                d.y += bend_(static_cast<float>(x));
                out.d.pixel(x, y)[0] = d.x;
                out.d.pixel(x, y)[1] = d.y;
            }
        }
        return out;
    }
    static Matte painted(const std::function<bool(int, int)>& inside) {
        Matte out(kPaintedFrame);
        for (int y = 0; y < kPaintedFrame.height; ++y)
            for (int x = 0; x < kPaintedFrame.width; ++x)
                out.at(x, y) = inside(x, y) ? 255 : 0;
        return out;
    }
    Matte corrected(const Matte& key) const {
        return painted_sides({frame(0), key, frame(1), motion(), kPaintedUnit_px});
    }

    Recti somebody_ = kSomebody;
    std::function<PaintedRgb(int, int)> paint_ = somebody_color;
    std::function<float(float)> bend_ = [](float) { return 0.0f; };
};

// How much of somebody a matte of the next frame has, px.
int taken_of_somebody(const Matte& matte) {
    const Recti now = kSomebody.grown(-4);
    int taken = 0;
    for (int y = now.y0; y < now.y1; ++y)
        for (int x = now.x0; x < now.x1; ++x)
            taken += matte.at(x + kJumpStep.x, y + kJumpStep.y) > 127 ? 1 : 0;
    return taken;
}

bool on_painted_wall(int x, int y) {
    return kPaintedWall.contains(x, y);
}

TEST_F(PaintedSides, ExactPaintStaysAsItIs) {
    EXPECT_TRUE(corrected(painted([](int x, int y) {
                    return on_painted_wall(x, y) && !kSomebody.contains(x, y);
                })).empty());
}

TEST_F(PaintedSides, HalfOfSomebodyIsNotTheWall) {
    const Matte key = painted(on_painted_wall), out = corrected(key);
    ASSERT_FALSE(out.empty());
    for (int y = 0; y < kPaintedFrame.height; ++y) {
        for (int x = 0; x < kPaintedFrame.width; ++x) {
            if (kSomebody.grown(-3).contains(x, y)) {
                EXPECT_EQ(out.at(x, y), 0) << x << "," << y;
            } else if (!kSomebody.grown(3).contains(x, y)) {
                EXPECT_EQ(out.at(x, y), key.at(x, y)) << x << "," << y;
            }
        }
    }
}

TEST_F(PaintedSides, ARimOfWallAroundSomebodyIsTheWall) {
    somebody_ = {150, 60, 200, 130};
    const Recti loosely = somebody_.grown(8);
    const Matte out = corrected(
        painted([&](int x, int y) { return on_painted_wall(x, y) && !loosely.contains(x, y); }));
    ASSERT_FALSE(out.empty());
    for (const Vec2i p : {Vec2i(145, 90), Vec2i(204, 90), Vec2i(170, 134)})
        EXPECT_EQ(out.at(p.x, p.y), 255) << p.x << "," << p.y;
    for (const Vec2i p : {Vec2i(175, 90), Vec2i(153, 63), Vec2i(30, 90)})
        EXPECT_EQ(out.at(p.x, p.y), 0) << p.x << "," << p.y;
}

TEST_F(PaintedSides, WhatHasTheSurfacesColoursIsNotTakenOut) {
    // A part of an animal may well move by itself.
    paint_ = [](int x, int y) { return painted_wall_color(x + 3, y + 5); };
    EXPECT_TRUE(corrected(painted(on_painted_wall)).empty());
}

TEST_F(PaintedSides, OfASurfaceThatBendsNothingIsSaid) {
    bend_ = [](float x) { return 4 * std::sin(0.05f * x); };
    EXPECT_TRUE(corrected(painted(on_painted_wall)).empty());
}

TEST_F(PaintedSides, TheWalkGoesByThem) {
    MatteWalker walker(frame(0), painted(on_painted_wall));
    const MatteEstimate estimate = walker.advance(frame(1), motion());
    EXPECT_EQ(taken_of_somebody(estimate.matte), 0);
    EXPECT_EQ(estimate.matte.at(200, 100), 255);
}

TEST_F(PaintedSides, TheWalkGoesByThemAlsoAfterAHold) {
    MatteWalker walker(frame(0), painted(on_painted_wall));
    (void)walker.advance(frame(0), FlowField(kPaintedFrame));
    const MatteEstimate estimate = walker.advance(frame(1), motion());
    EXPECT_EQ(taken_of_somebody(estimate.matte), 0);
}

}  // namespace
}  // namespace weft
