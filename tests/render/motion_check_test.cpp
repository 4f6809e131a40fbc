#include "app/shot/motion_check.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

constexpr Size kSize{160, 96};

// A pattern that lies `moved` to the right.
Matte pattern(float moved, float light = 1) {
    Matte out(kSize);
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const float u = static_cast<float>(x) - moved, v = static_cast<float>(y);
            const float level =
                120 + 50 * std::sin(0.31f * u + 0.17f * v) + 45 * std::sin(0.23f * v - 0.11f * u);
            out.at(x, y) = static_cast<std::uint8_t>(light * level);
        }
    }
    return out;
}

FlowField all(float dx, float dy) {
    FlowField out(kSize);
    for (int i = 0; i < kSize.width * kSize.height; ++i)
        out.d.data()[2 * i] = dx, out.d.data()[2 * i + 1] = dy;
    return out;
}

MotionFit fit_of(const FlowField& flow, const Matte& cur, const Matte& next) {
    const auto fit = compare_motion(flow, cur, next, Matte(kSize, 255));
    EXPECT_TRUE(fit);
    return fit.value_or(MotionFit());
}

TEST(MotionCheck, ZerosContradictAPictureThatMoves) {
    const MotionFit fit = fit_of(all(0, 0), pattern(0), pattern(5));
    EXPECT_TRUE(fit.still);
    EXPECT_TRUE(fit.contradicted());
    EXPECT_NEAR(fit.estimated_px, 5, 0.5);
}

TEST(MotionCheck, TheTrueMotionAndTrueStillnessFit) {
    EXPECT_FALSE(fit_of(all(5, 0), pattern(0), pattern(5)).contradicted());
    const MotionFit still = fit_of(all(0, 0), pattern(0), pattern(0));
    EXPECT_TRUE(still.still);
    EXPECT_FALSE(still.contradicted());
    EXPECT_FALSE(fit_of(all(0, 0), pattern(0), pattern(0, 0.8f)).contradicted()) << "light only";
}

TEST(MotionCheck, ADirectionThatIsTurnedRoundContradicts) {
    const MotionFit fit = fit_of(all(-5, 0), pattern(0), pattern(5));
    EXPECT_FALSE(fit.still);
    EXPECT_TRUE(fit.contradicted());
    EXPECT_NEAR(fit.apart_px, 10, 0.5);
}

TEST(MotionCheck, NothingIsSaidOfAFewPixels) {
    Matte few(kSize);
    few.at(3, 3) = 255;
    EXPECT_FALSE(compare_motion(all(0, 0), pattern(0), pattern(5), few));
}

}  // namespace
}  // namespace weft
