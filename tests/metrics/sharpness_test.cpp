#include "engine/metrics/sharpness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

using synthetic::waves;

constexpr Size kSharpnessSize{160, 140};

TEST(Sharpness, OfAPictureAgainstItselfIsOne) {
    const ImageF1 p = waves(kSharpnessSize, 6, 80);
    const SharpnessKept k = sharpness_kept(p, p, Matte(kSharpnessSize, 255));
    EXPECT_EQ(k.laplacian, 1.0);
    EXPECT_EQ(k.contrast, 1.0);
    EXPECT_EQ(k.pixels, 158 * 138);
}

TEST(Sharpness, OfABlurredWaveIsTheBlursGainAtItsFrequency) {
    // A Gaussian of σ px takes a wave of period P down to exp(−2 π² σ² / P²) of its amplitude.
    for (const double sigma : {0.5, 1.0}) {
        const double gain =
            std::exp(-2 * synthetic::kPi * synthetic::kPi * sigma * sigma / (6 * 6));
        const SharpnessKept k =
            sharpness_kept(waves(kSharpnessSize, 6, 80 * gain), waves(kSharpnessSize, 6, 80),
                           Matte(kSharpnessSize, 255));
        EXPECT_NEAR(k.laplacian, gain, 0.01) << "sigma " << sigma;
        EXPECT_NEAR(k.contrast, gain, 0.01) << "sigma " << sigma;
    }
}

TEST(Sharpness, IsNotChangedByLight) {
    const ImageF1 p = waves(kSharpnessSize, 6, 60);
    ImageF1 lit = p;
    for (int y = 0; y < kSharpnessSize.height; ++y) {
        for (int x = 0; x < kSharpnessSize.width; ++x)
            lit.at(x, y) *=
                0.7f + 0.5f * static_cast<float>(x) / static_cast<float>(kSharpnessSize.width);
    }
    EXPECT_NEAR(sharpness_kept(lit, p, Matte(kSharpnessSize, 255)).laplacian, 1.0, 0.02);
}

TEST(Sharpness, IgnoresTheRegionsEdgeAndWhatLiesOutside) {
    const Matte region = synthetic::rectangle(kSharpnessSize, {40, 40, 100, 100});
    const ImageF1 p = waves(kSharpnessSize, 6, 80);
    ImageF1 other = p;
    for (int y = 0; y < kSharpnessSize.height; ++y) {
        for (int x = 0; x < kSharpnessSize.width; ++x) {
            if (region.at(x, y) == 0) other.at(x, y) = x % 2 == 0 ? 255.0f : 0.0f;
        }
    }
    const SharpnessKept k = sharpness_kept(other, p, region);
    EXPECT_EQ(k.laplacian, 1.0);
    EXPECT_EQ(k.pixels, 52 * 52);
    other.at(70, 70) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(sharpness_kept(other, p, region).laplacian, 1.0);
}

TEST(Sharpness, SaysNothingOfTooFewPixelsOrAFlatTexture) {
    const ImageF1 p = waves(kSharpnessSize, 6, 80);
    EXPECT_EQ(sharpness_kept(p, p, synthetic::rectangle(kSharpnessSize, {40, 40, 60, 60})).pixels,
              0);
    EXPECT_EQ(sharpness_kept(p, ImageF1(kSharpnessSize, 90.0f), Matte(kSharpnessSize, 255)).pixels,
              0);
}

}  // namespace
}  // namespace weft
