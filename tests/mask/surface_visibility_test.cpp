#include "engine/mask/surface_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/mask/matte_box.h"

namespace weft {
namespace {

Matte box(int x, int y, int width, int height) {
    Matte matte(Size{100, 80});
    for (int row = y; row < y + height; ++row)
        std::fill_n(matte.row(row) + x, width, std::uint8_t{255});
    return matte;
}

double score(const Matte& matte, const Matte& holdout = {}) {
    return surface_visibility(matte, holdout).score();
}

TEST(MatteBox, HoldsWhatIsAtLeastHalfOrAsGiven) {
    Matte matte = box(10, 10, 20, 10);
    matte.row(50)[90] = 100;
    EXPECT_EQ(matte_box(matte), (Recti{10, 10, 30, 20}));
    EXPECT_EQ(matte_box(matte, 1), (Recti{10, 10, 91, 51}));
    EXPECT_TRUE(matte_box(Matte(Size{5, 5})).empty());
    EXPECT_TRUE(matte_box(Matte()).empty());
}

TEST(SurfaceVisibility, CountsCoverage) {
    Matte matte = box(10, 10, 20, 10);
    matte.row(12)[12] = 127;
    const SurfaceVisibility seen = surface_visibility(matte, {});
    EXPECT_NEAR(seen.full_px, 199.5, 0.01);
    EXPECT_NEAR(seen.visible_px, 199.5, 0.01);
    EXPECT_EQ(seen.cut, 0);
    EXPECT_NEAR(seen.soft, 1.0 / 200, 1e-9);
    EXPECT_EQ(score(Matte(Size{100, 80})), 0);
    EXPECT_EQ(score(Matte()), 0);
}

TEST(SurfaceVisibility, HiddenHalvesCountLessThanSmallSurfaces) {
    const Matte whole = box(10, 10, 40, 40), small = box(10, 10, 20, 40);
    EXPECT_LT(score(whole, box(0, 0, 30, 80)), score(small));
    EXPECT_LT(score(small), score(whole));
    EXPECT_EQ(score(whole, box(0, 0, 100, 80)), 0);
}

TEST(SurfaceVisibility, ASurfaceCutByTheBorderCountsLess) {
    EXPECT_LT(score(box(0, 10, 20, 40)), score(box(10, 10, 20, 40)));
    EXPECT_NEAR(surface_visibility(box(0, 10, 20, 40), {}).cut, 40.0 / 116, 1e-9);
}

TEST(SurfaceVisibility, ABlurredMatteCountsLess) {
    const Matte sharp = box(40, 20, 20, 40);
    Matte blurred(sharp.size());  // the same area, moved by 20 px while the shutter was open
    for (int y = 20; y < 60; ++y) {
        for (int x = 30; x < 70; ++x) {
            const int in = std::min({x - 30, 69 - x, 20});
            blurred.row(y)[x] = static_cast<std::uint8_t>(255 * in / 20);
        }
    }
    EXPECT_LT(score(blurred), 0.5 * score(sharp));
}

TEST(SurfaceVisibility, TheFirstStaysUnlessAnotherIsMuchBetter) {
    EXPECT_EQ(first_well_shown({60, 80, 100}), 0u);
    EXPECT_EQ(first_well_shown({0, 10, 95, 100, 100}), 2u);
    EXPECT_EQ(first_well_shown({49, 60, 89, 100}), 3u);
    EXPECT_EQ(first_well_shown({5}), 0u);
    EXPECT_EQ(first_well_shown({0, 0}), std::nullopt);
    EXPECT_EQ(first_well_shown({}), std::nullopt);
}

}  // namespace
}  // namespace weft
