// Where light and paint may have been taken for each other.
#include "engine/lighting/light_doubt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/lighting/shading.h"

namespace weft {
namespace {

constexpr int kWidth = 240, kHeight = 160;
const Matte kWallMatte(Size{kWidth, kHeight}, 255);

// A plain wall; `blot`: how dark a blot in its middle is, which may be a stain or a shadow.
ImageF3 wall(float blot) {
    ImageF3 plate(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const float u = static_cast<float>(x - kWidth / 2) / 14;
            const float v = static_cast<float>(y - kHeight / 2) / 14;
            const float light = 0.5f * (1 - blot * std::exp(-u * u - v * v));
            for (int c = 0; c < 3; ++c)
                plate.pixel(x, y)[c] = light;
        }
    }
    return plate;
}

TEST(LightDoubt, IsSmallOnAPlainWall) {
    const Shading shading = estimate_shading(wall(0), kWallMatte, {});
    ASSERT_EQ(shading.sure.size(), shading.value.size());
    EXPECT_GT(shading.sure.at(kWidth / 4, kHeight / 4), 240);
    EXPECT_GT(shading.sure.at(20, 20), 240);
}

TEST(LightDoubt, IsLargeAtABlotAndOnlyThere) {
    const Shading shading = estimate_shading(wall(0.9f), kWallMatte, {});
    EXPECT_LT(shading.sure.at(kWidth / 4, kHeight / 4), 128);
    EXPECT_GT(shading.sure.at(16, 12), 200);
}

TEST(LightDoubt, GrowsWithWhatMayBeEither) {
    int before = 256;
    for (const float blot : {0.1f, 0.4f, 0.9f}) {
        const int sure =
            estimate_shading(wall(blot), kWallMatte, {}).sure.at(kWidth / 4, kHeight / 4);
        EXPECT_LT(sure, before) << blot;
        before = sure;
    }
}

TEST(LightDoubt, LeavesOutWhatIsOutside) {
    Matte half(Size{kWidth, kHeight});
    for (int y = 0; y < kHeight; ++y)
        std::fill(half.row(y), half.row(y) + kWidth / 2, 255);
    const Shading shading = estimate_shading(wall(0.5f), half, {});
    EXPECT_GT(shading.sure.at(20, 20), 0);
    EXPECT_EQ(shading.sure.at(kWidth / 2 - 20, 20), 0);
}

TEST(LightDoubt, LeavesOutWhatColoursHaveDecided) {
    SurfaceSample sample;
    sample.box = {0, 0, 120, 80};
    sample.full = {240, 160};
    sample.downscale = 2;
    sample.weight = ImageF1(sample.box.size(), 1.0f);
    sample.luma = ImageF1(sample.box.size());
    sample.daylight = ImageF1(sample.box.size());
    for (int y = 0; y < 80; ++y)
        for (int x = 50; x < 70; ++x)
            sample.luma.row(y)[x] = sample.daylight.row(y)[x] = -1;
    const ImageF1 decided = light_doubt(sample, sample.luma, {});
    sample.daylight = {};
    const ImageF1 open = light_doubt(sample, sample.luma, {});
    EXPECT_LT(decided.at(60, 40), 0.01f);
    EXPECT_GT(open.at(60, 40), 0.3f);
}

}  // namespace
}  // namespace weft
