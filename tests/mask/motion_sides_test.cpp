// What moves with the surface and what moves with its surroundings.
#include "engine/mask/motion_sides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr Size kSidesFrame{160, 120};
const Recti kAll{0, 0, kSidesFrame.width, kSidesFrame.height};
constexpr int kLeft = 40, kRight = 120, kStrip = 116;  // columns; the strip is the matte's last 4

// The matte as it was painted: of the surface, and of a strip of what is behind it.
ImageF1 painted() {
    Image<std::uint8_t, 1> inside(kSidesFrame);
    for (int y = 10; y < kSidesFrame.height - 10; ++y)
        for (int x = kLeft; x < kRight; ++x)
            inside.at(x, y) = 1;
    return signed_distance(inside, 40);
}

// What the evidence says after some frames in which nothing leaves its place by much: `motion`
// gives prev_from_cur of the matte's pixels, the strip and the surroundings move by `around`.
ImageF1 after(int frames, const std::function<Vec2(int, int)>& motion, Vec2 around) {
    const ImageF1 phi = painted();
    FlowField flow(kSidesFrame);
    ImageF2 outside(kSidesFrame);
    for (int y = 0; y < kSidesFrame.height; ++y) {
        for (int x = 0; x < kSidesFrame.width; ++x) {
            const bool surface = phi.at(x, y) > 0 && x < kStrip;
            const Vec2 d = surface ? motion(x, y) : around;
            flow.d.pixel(x, y)[0] = d.x, flow.d.pixel(x, y)[1] = d.y;
            outside.pixel(x, y)[0] = around.x, outside.pixel(x, y)[1] = around.y;
        }
    }
    MotionSides sides;
    ImageF1 odds;
    for (int k = 0; k < frames; ++k)
        odds = sides.advance({phi, flow, outside, kAll, 1.0f});
    return odds;
}

const auto kStiffly = [](int, int) { return Vec2(-2.5f, 0); };

TEST(MotionSides, TellAPaintedStripOfTheBackgroundFromTheSurface) {
    const ImageF1 odds = after(6, kStiffly, {0, 0});
    EXPECT_GT(odds.at(70, 60), 2);
    EXPECT_LT(odds.at(kStrip + 2, 60), -2);
    EXPECT_LT(odds.at(kRight + 10, 60), -2);
}

TEST(MotionSides, AddUpFromFrameToFrame) {
    const float first = after(1, kStiffly, {0, 0}).at(kStrip + 2, 60);
    const float third = after(3, kStiffly, {0, 0}).at(kStrip + 2, 60);
    EXPECT_LT(first, -0.5f);
    EXPECT_LT(third, 2 * first);
    EXPECT_GE(after(80, kStiffly, {0, 0}).at(kStrip + 2, 60), -MotionSides::kMost);
}

TEST(MotionSides, SayNothingWhereBothMoveAlike) {
    const ImageF1 odds = after(6, kStiffly, {-2.2f, 0.1f});
    EXPECT_EQ(odds.at(70, 60), 0);
    EXPECT_EQ(odds.at(kStrip + 2, 60), 0);
}

TEST(MotionSides, SayNothingOfASurfaceThatBends) {
    const auto waving = [](int x, int y) {
        return Vec2(3 * std::sin(static_cast<float>(x) / 9),
                    3 * std::cos(static_cast<float>(y) / 7));
    };
    const ImageF1 odds = after(6, waving, {6, 0});
    EXPECT_EQ(odds.at(70, 60), 0);
    EXPECT_EQ(odds.at(kStrip + 2, 60), 0);
}

TEST(MotionSides, FollowATurningSurface) {
    const auto turning = [](int x, int y) {
        return Vec2(0.05f * static_cast<float>(y - 60), -0.05f * static_cast<float>(x - 75)) +
               Vec2(3, 0);
    };
    const ImageF1 odds = after(6, turning, {0, 0});
    EXPECT_GT(odds.at(70, 60), 1.5f);
    EXPECT_LT(odds.at(kStrip + 2, 60), -1.5f);
}

}  // namespace
}  // namespace weft
