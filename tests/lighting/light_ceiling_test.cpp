// The brightest that light on a surface is believed to be.
#include "engine/lighting/light_ceiling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace weft {
namespace {

constexpr Size kPlate{80, 60}, kSmall{40, 30};
constexpr float kReference = 0.04f;

ImageF3 plate_of(float dark, float bright) {
    ImageF3 plate(kPlate, dark);
    for (int y = 0; y < kPlate.height / 10; ++y)
        std::fill(plate.row(y), plate.row(y) + plate.stride(), bright);
    return plate;
}

// A dark surface, all of it at S₀ but for one place.
Shading surface_with(float peak, std::uint8_t sure) {
    Shading shading{ImageF1(kSmall, kReference), 2, kPlate};
    shading.inside = Matte(kSmall, 255);
    shading.sure = Matte(kSmall, sure);
    shading.value.at(20, 15) = peak;
    return shading;
}

float gain_of_peak(Shading shading, float ceiling) {
    limit_light(shading, kReference, mean_light(shading), ceiling);
    return shading.value.at(20, 15) / kReference;
}

TEST(LightCeiling, IsThePlatesBrightestLightOnTheSurface) {
    EXPECT_NEAR(light_ceiling(plate_of(0.05f, 0.72f), 0.4f), 0.72f / (0.6f * 0.4f), 1e-4f);
    EXPECT_EQ(light_ceiling(plate_of(0.05f, 0.05f), 1.0f), 1.5f) << "the exposure is a guess";
}

TEST(LightCeiling, IgnoresWhatIsNotFinite) {
    ImageF3 plate = plate_of(0.05f, 0.72f);
    const float before = light_ceiling(plate, 0.4f);
    plate.pixel(40, 40)[1] = std::numeric_limits<float>::infinity();
    plate.pixel(42, 40)[0] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NEAR(light_ceiling(plate, 0.4f), before, 1e-4f);
    EXPECT_EQ(light_ceiling(ImageF3(), 0.4f), 1.5f);
}

TEST(LightCeiling, HoldsASheenThatMayBePaint) {
    const float gain = gain_of_peak(surface_with(0.8f, 1), 2.5f);
    EXPECT_LE(gain, 2.6f);
    EXPECT_GT(gain, 2.3f);
}

TEST(LightCeiling, LeavesUsualLightAsItIs) {
    for (const float gain : {0.1f, 0.7f, 1.0f, 1.2f}) {
        EXPECT_EQ(gain_of_peak(surface_with(gain * kReference, 1), 2.5f),
                  gain * kReference / kReference);
    }
}

TEST(LightCeiling, BelievesMoreWhereLightIsSure) {
    EXPECT_NEAR(gain_of_peak(surface_with(4.5f * kReference, 255), 2.5f), 4.5f, 1e-4f);
    EXPECT_LE(gain_of_peak(surface_with(2.0f, 255), 2.5f), 10.0f);
}

TEST(LightCeiling, GrowsSteadilyWithTheLight) {
    float before = 0;
    for (int k = 0; k < 40; ++k) {
        const float gain = 0.5f * std::pow(1.1f, static_cast<float>(k));
        const float now = gain_of_peak(surface_with(gain * kReference, 60), 2.5f);
        EXPECT_GE(now, before);
        before = now;
    }
}

TEST(LightCeiling, RisesWithAFlash) {
    Shading flash = surface_with(5 * kReference, 1);
    for (int y = 0; y < kSmall.height; ++y)
        std::fill(flash.value.row(y), flash.value.row(y) + kSmall.width, 5 * kReference);
    limit_light(flash, kReference, kReference, 2.5f);
    EXPECT_NEAR(flash.value.at(3, 3) / kReference, 5, 1e-4f);
}

TEST(LightCeiling, LeavesPassesAndContinuesBeyondTheMatte) {
    Shading pass = surface_with(0.8f, 1);
    pass.sure = {};
    EXPECT_NEAR(gain_of_peak(std::move(pass), 2.5f), 20, 1e-3f);

    Shading half = surface_with(0.8f, 1);
    for (int y = 0; y < kSmall.height; ++y) {
        for (int x = kSmall.width / 2 + 1; x < kSmall.width; ++x) {
            half.inside.at(x, y) = half.sure.at(x, y) = 0;
            half.value.at(x, y) = 0.8f;
        }
    }
    limit_light(half, kReference, kReference, 2.5f);
    EXPECT_LE(half.value.at(kSmall.width - 2, 15) / kReference, 2.6f);
}

}  // namespace
}  // namespace weft
