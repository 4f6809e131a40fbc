#include "engine/lighting/plate_exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr Size kShot{240, 160};
constexpr Recti kSurface{20, 20, 220, 140};
constexpr int kMiddle = 120;  // of the surface, in x

Matte surface_matte() {
    Matte out(kShot);
    for (int y = kSurface.y0; y < kSurface.y1; ++y)
        std::fill(out.row(y) + kSurface.x0, out.row(y) + kSurface.x1, 255);
    return out;
}

// Grey paint on the surface, in a light that is `right` times as strong in its right half.
ImageF3 lit_plate(float surface, float rest, float right = 1) {
    ImageF3 plate(kShot, rest);
    for (int y = kSurface.y0; y < kSurface.y1; ++y)
        for (int x = kSurface.x0; x < kSurface.x1; ++x)
            std::fill_n(plate.pixel(x, y), 3, surface * (x < kMiddle ? 1.0f : right));
    return plate;
}

Shading light_of(float right) {
    Shading out{ImageF1(kShot, 1.0f), 1, kShot};
    for (int y = 0; y < kShot.height; ++y)
        std::fill(out.value.row(y) + kMiddle, out.value.row(y) + kShot.width, right);
    return out;
}

float white_of(float surface, float rest, const ExposureGreys& greys = {}) {
    return plate_exposure(lit_plate(surface, rest), surface_matte(), nullptr, 1, greys).white;
}

TEST(PlateExposure, IsTheMeanOfThreeBeliefs) {
    const auto beliefs = [](float surface, float bright) {
        return std::cbrt(surface / 0.25f * (bright / 0.6f) * 0.9f);
    };
    EXPECT_NEAR(white_of(0.01f, 0.01f), beliefs(0.01f, 0.01f), 0.002f) << "at night";
    EXPECT_NEAR(white_of(0.05f, 0.6f), beliefs(0.05f, 0.6f), 0.01f);
    EXPECT_NEAR(white_of(0.25f, 0.4f), beliefs(0.25f, 0.4f), 0.01f);
    EXPECT_GE(white_of(0, 0), 1.0f / 16);
    EXPECT_EQ(plate_exposure(lit_plate(0.02f, 0.02f), Matte(kShot), nullptr, 1).white, 1.0f)
        << "nothing is shown";
}

TEST(PlateExposure, NeverClipsWhiteByItself) {
    for (const float surface : {0.3f, 0.6f, 0.85f})
        for (const float rest : {0.3f, 0.7f, 1.0f})
            EXPECT_LE(white_of(surface, rest), 0.951f) << surface << " beside " << rest;
    EXPECT_NEAR(white_of(0.8f, 0.95f), 0.95f, 0.001f) << "a white wall by a window";
    EXPECT_NEAR(white_of(0.98f, 0.98f), 0.98f / 0.95f, 0.001f) << "which is as bright as its plate";
    ExposureGreys unbounded;
    unbounded.ends_at_one = false;
    EXPECT_GT(white_of(0.8f, 0.8f, unbounded), 1.4f) << "scene-linear";
}

TEST(PlateExposure, TakesTheFullestLightForWhite) {
    const Shading light = light_of(3);
    const PlateExposure found =
        plate_exposure(lit_plate(0.15f, 0.6f, 3), surface_matte(), &light, 1);
    EXPECT_NEAR(found.white, 0.95f / 3, 0.005f);
    EXPECT_NEAR(found.fullest, 0.95f, 0.01f);
    const Shading doubled{light.value, 1, kShot};
    const PlateExposure same =
        plate_exposure(lit_plate(0.15f, 0.6f, 3), surface_matte(), &doubled, 2);
    EXPECT_NEAR(same.white, 2 * found.white, 0.01f) << "relative to S₀";
}

// Large white patches that were taken for light: paint in the shade would reflect more than all.
// What is left of light and plate in a cast shadow is rounding.
TEST(PlateExposure, TakesNoPaintFromWhereThereIsNoLight) {
    const Shading shaded = light_of(1e-5f);
    const PlateExposure found =
        plate_exposure(lit_plate(0.2f, 0.6f, 1e-3f), surface_matte(), &shaded, 1);
    EXPECT_LT(found.white, 1);
}

TEST(PlateExposure, KeepsPaintPossible) {
    const Shading light = light_of(5);
    const PlateExposure found =
        plate_exposure(lit_plate(0.4f, 0.6f, 2), surface_matte(), &light, 1);
    EXPECT_NEAR(found.white, 0.4f / 0.95f, 0.005f);
    EXPECT_NEAR(found.fullest, 5 * found.white, 0.05f);
}

}  // namespace
}  // namespace weft
