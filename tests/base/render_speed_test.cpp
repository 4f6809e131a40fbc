#include "app/base/render_speed.h"

#include <gtest/gtest.h>

namespace weft::test {
namespace {

TEST(RenderSpeed, IsCalibratedByMeasuredTime) {
    // Estimated 100 s, took 25 s: four times as fast; half of the correction in one step.
    const double once = calibrated_speed(1, 100, 25);
    EXPECT_NEAR(once, 2, 1e-9);
    EXPECT_NEAR(calibrated_speed(once, 50, 25), 2 * 1.41421, 1e-4);
    EXPECT_EQ(calibrated_speed(3, 0, 25), 3);
    EXPECT_EQ(calibrated_speed(3, 25, 0), 3);
    EXPECT_EQ(calibrated_speed(1, 1e9, 1e-3), 20);
}

}  // namespace
}  // namespace weft::test
