#include "engine/motion/interpolation_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/motion/photometric_register.h"
#include "engine/motion/photometric_samples.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

// A local mean over so much that it takes nothing from the noise.
constexpr float kAllOfIt = 1e6f;

TEST(InterpolationNoise, IsAllThereOnPixelsAndLessBetweenThem) {
    const InterpolationNoise white(0, kAllOfIt);
    EXPECT_FLOAT_EQ(white.variance({0, 0}), 1);
    EXPECT_FLOAT_EQ(white.variance({1, 1}), 1);
    // Catmull–Rom halfway: 2 · (1/16)² + 2 · (9/16)².
    EXPECT_NEAR(white.variance({0.5f, 0}), 0.640625f, 1e-6f);
    EXPECT_NEAR(white.variance({0.5f, 0.5f}), 0.640625f * 0.640625f, 1e-6f);
    EXPECT_NEAR(InterpolationNoise(0.5f, kAllOfIt).variance({0.5f, 0}), 0.87f, 0.01f);
}

TEST(InterpolationNoise, ItsSlopeIsTheDerivative) {
    const InterpolationNoise noise(0.4f, 4);
    constexpr float kStep = 1.0f / 32;
    for (const Vec2 f : {Vec2(0.25f, 0.5f), Vec2(0.75f, 0.25f), Vec2(0.5f, 0.125f)}) {
        const Vec2 by_x(kStep, 0), by_y(0, kStep);
        EXPECT_NEAR(noise.slope(f).x,
                    (noise.variance(f + by_x) - noise.variance(f - by_x)) / (2 * kStep), 0.01f);
        EXPECT_NEAR(noise.slope(f).y,
                    (noise.variance(f + by_y) - noise.variance(f - by_y)) / (2 * kStep), 0.01f);
    }
}

TEST(InterpolationNoise, OfWhatIsSmoothHasNoSlope) {
    EXPECT_EQ(InterpolationNoise().slope({0.3f, 0.7f}), Vec2(0));
    EXPECT_NEAR(InterpolationNoise(0.999f, kAllOfIt).slope({0.3f, 0.7f}).x, 0, 1e-3f);
}

TEST(InterpolationNoise, IsLessCorrelatedWithoutItsLocalMean) {
    EXPECT_NEAR(InterpolationNoise(0.5f, kAllOfIt).of_neighbours(), 0.5f, 1e-3f);
    EXPECT_LT(InterpolationNoise(0.5f, 4).of_neighbours(), 0.4f);
}

// Faint plaster under grain, on both frames.
class FaintWall : public testing::Test {
  protected:
    static constexpr Size kFrame{480, 270};

    static RegistrationPicture picture(Vec2 moved, std::uint64_t seed) {
        const WaveTexture plaster(31);
        Rng grain(seed);
        Matte luma = draw(
            kFrame, [&](Vec2 p) { return 0.5f + 0.2f * (plaster((p + moved) * 0.8f) - 0.5f); });
        for (int y = 0; y < kFrame.height; ++y) {
            for (int x = 0; x < kFrame.width; ++x) {
                // About a Gaussian of 3.5 levels.
                double sum = 0;
                for (int k = 0; k < 4; ++k)
                    sum += grain.uniform() - 0.5;
                luma.at(x, y) = static_cast<std::uint8_t>(std::lround(luma.at(x, y) + 6 * sum));
            }
        }
        return registration_picture(luma, draw(kFrame, [](Vec2) { return 1.0f; }));
    }
};

TEST_F(FaintWall, ShowsItsWhiteNoiseThroughTheSmoothingOfThePicture) {
    const InterpolationNoise noise =
        noise_between(picture({0.3f, 0}, 1), picture({0, 0}, 2), moved_by(kFrame, {-0.3f, 0}));
    // Smoothed by σ = 0.6 px, on pixels: neighbours correlate by 0.445; the mean of 5 × 5, twice.
    const InterpolationNoise expected(0.445f, 4);
    EXPECT_NEAR(noise.variance({0.5f, 0}), expected.variance({0.5f, 0}), 0.04f);
}

TEST_F(FaintWall, IsRegisteredBetweenPixelsAsWellAsOnThem) {
    float sum = 0;
    int n = 0;
    for (const float step : {0.1f, 0.2f, 0.3f, 0.7f, 0.8f, 0.9f}) {
        const auto k = static_cast<std::uint64_t>(10 * step);
        const RegistrationPicture anchor = picture({0, 0}, 100 + k), cur = picture({step, 0}, k);
        const PlanarRegistration found =
            register_planar(anchor, cur, moved_by(kFrame, {0.5f, 0}), {});
        ASSERT_TRUE(found.found);
        const LatticeField refined = refine_planar(anchor, cur, found.anchor_from_cur, {});
        const float error = refined.at({240, 135}).x - step;
        sum += step < 0.5f ? error : -error;  // towards half a pixel
        ++n;
    }
    EXPECT_LT(std::abs(sum / static_cast<float>(n)), 0.08f);
}

}  // namespace
}  // namespace weft
