// Where light and paint may have been taken for each other.
#include "engine/lighting/light_doubt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

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
    const LogShading all_light{sample.luma, {sample.weight}};
    const ImageF1 decided = light_doubt(sample, all_light, {});
    sample.daylight = {};
    const ImageF1 open = light_doubt(sample, all_light, {});
    EXPECT_LT(decided.at(60, 40), 0.01f);
    EXPECT_GT(open.at(60, 40), 0.3f);
}

TEST(LightDoubt, LeavesOutWhatIsPrintedOnItsGround) {
    ImageF3 lined = wall(0);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c)
                lined.pixel(x, y)[c] *= (y % 34 < 4 ? 0.1f : 1.0f) *
                                        std::exp(0.1f * std::sin(0.14f * static_cast<float>(x)));
    ShadingOptions options;
    options.pattern_px = 8;
    const Shading shading = estimate_shading(lined, kWallMatte, options);
    for (int y = 6; y < kHeight / 2 - 6; ++y)
        for (int x = 6; x < kWidth / 2 - 6; ++x)
            ASSERT_GT(shading.sure.at(x, y), 200) << x << ", " << y;
}

// How many places are told apart (or not), and on how many of them light is off by 15 %.
struct Tally {
    int places = 0, wrong = 0;
    [[nodiscard]] double share() const { return static_cast<double>(wrong) / std::max(1, places); }
};
struct Verdicts {
    Tally sure, unsure;
};

// `paint` and `light`: of x and y, grey.
template <class Paint, class Light>
void judge(const Paint& paint, const Light& light, Verdicts& verdicts) {
    ImageF3 plate(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            std::fill_n(plate.pixel(x, y), 3, paint(x, y) * light(x, y));
    ShadingOptions options;
    options.pattern_px = 8;
    const Shading found = estimate_shading(plate, kWallMatte, options);
    std::vector<float> ratios;
    const Recti inside{4, 4, kWidth / 2 - 4, kHeight / 2 - 4};
    for (int y = inside.y0; y < inside.y1; ++y)
        for (int x = inside.x0; x < inside.x1; ++x)
            ratios.push_back(found.value.at(x, y) / light(2 * x + 1, 2 * y + 1));
    std::vector<float> sorted = ratios;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const float level = sorted[sorted.size() / 2];
    auto ratio = ratios.begin();
    for (int y = inside.y0; y < inside.y1; ++y) {
        for (int x = inside.x0; x < inside.x1; ++x) {
            Tally& tally = found.sure.at(x, y) < 128 ? verdicts.unsure : verdicts.sure;
            tally.places += 1;
            tally.wrong += std::abs(std::log(*ratio++ / level)) > 0.15f ? 1 : 0;
        }
    }
}

TEST(LightDoubt, IsBorneOutWherePaintAndLightAreKnown) {
    const auto even = [](int, int) { return 0.5f; };
    const auto folds = [](int x, int y) {
        const auto u = static_cast<float>(x), v = static_cast<float>(y);
        return 0.5f * std::exp(0.12f * std::sin(0.16f * u + 0.07f * v + std::sin(v / 19)));
    };
    const auto white = [](int, int) { return 1.0f; };
    Verdicts told;
    judge(white, folds, told);
    judge([](int, int y) { return y % 34 < 4 ? 0.1f : 1.0f; }, folds, told);
    judge([](int x, int y) { return x % 23 < 6 && y % 23 < 6 ? 0.1f : 1.0f; }, folds, told);
    judge([](int x, int y) { return (x / 3 + y / 3) % 2 == 0 ? 0.4f : 1.0f; }, even, told);
    EXPECT_LT(told.unsure.places, told.sure.places / 100);
    EXPECT_LT(told.sure.share(), 0.1);
    // As wide as shadows, and without a colour.
    Verdicts open;
    judge([](int x, int) { return x / 20 % 2 == 0 ? 0.25f : 1.0f; }, even, open);
    judge([](int x, int y) { return (x / 28 + y / 28) % 2 == 0 ? 0.2f : 1.0f; }, even, open);
    EXPECT_GT(open.unsure.places, open.sure.places / 2);
    EXPECT_GT(open.unsure.share(), 0.3);
}

}  // namespace
}  // namespace weft
