#include "engine/temporal/shutter.h"

#include <gtest/gtest.h>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kSize{200, 160};

LatticeField steady(Vec2 prev_from_cur) {
    return moved_by(kSize, prev_from_cur);
}

// Turned tiles in random tones that move by v a frame, seen through a shutter.
Matte blurred(Vec2 v, float degrees, int frame) {
    const auto sharp = [](Vec2 p) {
        const Vec2 q(0.9f * p.x + 0.44f * p.y, 0.9f * p.y - 0.44f * p.x);
        const auto cell = [](float x) {
            return static_cast<std::uint64_t>(std::floor(x / 9) + 512);
        };
        return static_cast<float>(mix64(cell(q.x) * 8192 + cell(q.y)) >> 40) /
               static_cast<float>(1 << 24);
    };
    constexpr int kInstants = 24;
    return draw(kSize, [&](Vec2 p) {
        float sum = 0;
        for (int k = 0; k < kInstants; ++k) {
            // Two by two places of the pixel's square in turn, as a camera's pixel has an area.
            const Vec2 place(k & 1 ? 0.25f : -0.25f, k & 2 ? 0.25f : -0.25f);
            const float time = static_cast<float>(frame) +
                               degrees / 360 * ((static_cast<float>(k) + 0.5f) / kInstants - 0.5f);
            sum += sharp(p + place - time * v);
        }
        return sum / kInstants;
    });
}

float measured(const std::vector<Vec2>& velocities, float degrees) {
    ShutterMeter meter;
    int frame = 0;
    for (const Vec2 v : velocities)
        meter.add(blurred(v, degrees, ++frame), Matte(kSize, 255), steady(-v));
    return meter.degrees();
}

TEST(Shutter, IsFoundByTheBlurAlongTheMotion) {
    for (const float degrees : {120.0f, 180.0f, 270.0f})
        EXPECT_NEAR(measured({{12, 3}, {9, -5}, {14, 4}}, degrees), degrees, 0.25f * degrees);
}

TEST(Shutter, ASharpPictureHasNone) {
    EXPECT_EQ(measured({{12, 3}, {9, -5}, {14, 4}}, 0), 0);
    EXPECT_EQ(measured({{9, 0}, {4.5f, 0}}, 0), 0) << "steps of the texture's own tiles";
}

// In a board of 90 px hardly any two places are 64 px apart both ways.
TEST(Shutter, IsFoundOnASmallRegion) {
    Matte small(kSize);
    for (int y = 35; y < 125; ++y)
        std::fill(small.row(y) + 55, small.row(y) + 145, 255);
    ShutterMeter meter;
    int frame = 0;
    for (const Vec2 v : {Vec2(12, 3), Vec2(9, -5), Vec2(14, 4)})
        meter.add(blurred(v, 180, ++frame), small, steady(-v));
    EXPECT_NEAR(meter.degrees(), 180, 60);
}

TEST(Shutter, WithoutMotionNothingIsSaid) {
    EXPECT_EQ(measured({{1, 0.5f}, {0, 0}}, 180), 0);
}

}  // namespace
}  // namespace weft
