#include "bench/baselines/poisson_clone.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

constexpr Size kSize{64, 48};

ImageU8x3 flat(std::uint8_t v) {
    return ImageU8x3(kSize, v);
}

ImageU8x3 waves() {
    ImageU8x3 out(kSize);
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = static_cast<std::uint8_t>(80 + 60 * std::sin(0.5 * x));
    return out;
}

Matte box(int x0, int y0, int x1, int y1) {
    Matte out(kSize);
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            out.at(x, y) = 255;
    return out;
}

TEST(PoissonClone, KeepsGradientsAndTakesThePlatesLevel) {
    const ImageU8x3 texture = waves();
    const ImageU8x3 out = poisson_clone(flat(180), texture, box(12, 10, 52, 40));
    // Over one period: the texture's contrast at the plate's level.
    int least = 255, largest = 0;
    for (int x = 20; x < 45; ++x) {
        least = std::min<int>(least, out.at(x, 25, 0));
        largest = std::max<int>(largest, out.at(x, 25, 0));
    }
    EXPECT_NEAR(largest - least, 120, 40);
    EXPECT_NEAR((largest + least) / 2, 180, 25);
}

TEST(PoissonClone, LeavesThePlateOutside) {
    const ImageU8x3 out = poisson_clone(flat(90), waves(), box(20, 15, 44, 35));
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const bool well_outside = x < 18 || x > 45 || y < 13 || y > 36;
            if (well_outside) {
                ASSERT_NEAR(out.at(x, y, 1), 90, 1) << x << "," << y;
            }
        }
    }
}

TEST(PoissonClone, ReachesThePicturesEdge) {
    const ImageU8x3 out = poisson_clone(flat(100), waves(), box(0, 0, 64, 48));
    int differing = 0;
    for (int x = 0; x < kSize.width; ++x)
        differing += std::abs(out.at(x, 24, 0) - 100) > 8;
    EXPECT_GT(differing, 30);
}

TEST(PoissonClone, IsThePlateWithoutAMatte) {
    EXPECT_TRUE(poisson_clone(flat(77), waves(), Matte(kSize)) == flat(77));
}

}  // namespace
}  // namespace weft
