#include <gtest/gtest.h>

#include <cmath>

#include "engine/lighting/painted_light.h"

namespace weft {
namespace {

TEST(PaintedLight, APointIsBrightInTheMiddleAndEndsAtItsRadius) {
    const auto lamps = parse_lamps("point 50,40 20 3");
    ASSERT_TRUE(lamps) << lamps.error().sentence();
    const Shading s = painted_shading(*lamps, 1, {120, 90});
    EXPECT_NEAR(s.value.at(25, 20), 3.0f, 0.05f);
    EXPECT_EQ(s.value.at(25, 33), 1.0f);
}

TEST(PaintedLight, APointIsRoundOnAnAnamorphicPlate) {
    const auto lamps = parse_lamps("point 40,40 20 3");
    ASSERT_TRUE(lamps);
    const Shading s = painted_shading(*lamps, 1, {80, 80}, PixelAspect(2));
    // Ten plate pixels to the side are as far as twenty up.
    EXPECT_GT(s.value.at(23, 20), 1.0f);
    EXPECT_EQ(s.value.at(26, 20), 1.0f);
    EXPECT_GT(s.value.at(20, 28), 1.0f);
    EXPECT_EQ(s.value.at(20, 31), 1.0f);
    const auto gradient = parse_lamps("gradient 20,0 20,80 1 3");
    const Shading along = painted_shading(*gradient, 1, {80, 80}, PixelAspect(2));
    EXPECT_FLOAT_EQ(along.value.at(3, 20), along.value.at(35, 20));
}

TEST(PaintedLight, DirectionalLightIsStrongestAtTheSideItComesFrom) {
    const auto lamps = parse_lamps("directional 90 2");  // from above
    ASSERT_TRUE(lamps);
    const Shading s = painted_shading(*lamps, 1, {100, 100});
    EXPECT_NEAR(s.value.at(10, 0), 2.0f, 0.05f);
    EXPECT_NEAR(s.value.at(10, 49), 0.5f, 0.02f);
}

TEST(PaintedLight, KeysAreInterpolatedAndLampsMultiply) {
    const auto lamps = parse_lamps("gradient 1: 0,0 0,10 2 2 | 11: 0,0 0,10 4 4; directional 0 1");
    ASSERT_TRUE(lamps) << lamps.error().sentence();
    EXPECT_FLOAT_EQ(painted_shading(*lamps, 6, {8, 8}).value.at(1, 1), 3.0f);
    EXPECT_FLOAT_EQ(painted_shading(*lamps, -5, {8, 8}).value.at(1, 1), 2.0f);
    EXPECT_FLOAT_EQ(painted_shading(*lamps, 50, {8, 8}).value.at(1, 1), 4.0f);
}

TEST(PaintedLight, MistakesAreNamed) {
    for (const char* wrong : {"spot 1 2", "point 1,2 3", "point a,2 3 4", "point 1,2 3 4 | 5,6 7 8",
                              "gradient 1: 0,0 0,1 1 1 | 1: 0,0 0,1 2 2"}) {
        const auto lamps = parse_lamps(wrong);
        ASSERT_FALSE(lamps) << wrong;
        EXPECT_EQ(lamps.error().code, ErrorCode::kUsage);
    }
}

TEST(PaintedLight, StrengthMayHaveKeys) {
    const auto keys = parse_keyed_numbers("1:1  11:0.5");
    ASSERT_TRUE(keys) << keys.error().sentence();
    EXPECT_FLOAT_EQ(keys->float_at(6)[0], 0.75f);
    EXPECT_TRUE(parse_keyed_numbers("")->empty());
    EXPECT_FALSE(parse_keyed_numbers("1:1 1:2"));
}

}  // namespace
}  // namespace weft
