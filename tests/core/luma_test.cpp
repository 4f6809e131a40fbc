#include "engine/core/luma.h"

#include <gtest/gtest.h>

#include "engine/core/linear_system.h"
#include "engine/core/smooth_step.h"
#include "engine/core/wrap.h"

namespace weft {
namespace {

TEST(Luma, WeightsAddUpToOneAndDiffer) {
    EXPECT_FLOAT_EQ(luma_709(1.0f, 1.0f, 1.0f), 1.0f);
    EXPECT_FLOAT_EQ(luma_601(1.0f, 1.0f, 1.0f), 1.0f);
    EXPECT_EQ(luma_709_code(255, 255, 255), 255);
    EXPECT_EQ(luma_709_code(0, 0, 0), 0);
    const float green[3] = {0, 1, 0};
    EXPECT_FLOAT_EQ(luma_709(green), 0.7152f);
    EXPECT_FLOAT_EQ(luma_601(green), 0.587f);
    for (int v = 0; v < 256; v += 5)
        EXPECT_NEAR(luma_709_code(v, 255 - v, 7), luma_709<double>(v, 255 - v, 7), 0.51);
}

TEST(Wrapped, IsTheRemainderFromZero) {
    for (int i = -12; i <= 12; ++i) {
        EXPECT_GE(wrapped(i, 5), 0);
        EXPECT_LT(wrapped(i, 5), 5);
        EXPECT_EQ((i - wrapped(i, 5)) % 5, 0);
    }
}

TEST(SmoothRise, GoesFromZeroToOneAndIsLevelAtBoth) {
    EXPECT_EQ(smooth_rise(0.0f), 0.0f);
    EXPECT_EQ(smooth_rise(0.5f), 0.5f);
    EXPECT_EQ(smooth_rise(1.0f), 1.0f);
    EXPECT_LT(smooth_rise(0.01f), 0.001f);
    EXPECT_EQ(smooth_step(3.0f, 2.0f, 4.0f), smooth_rise(0.5f));
}

TEST(LinearSystem, BothWaysGiveTheSameBits) {
    const LinearSystem<3> m{{{4, 1, 0.3, 1}, {1, 3, 0.7, 2}, {0.3, 0.7, 5, -1}}};
    std::vector<double> flat;
    for (const auto& row : m)
        flat.insert(flat.end(), row.begin(), row.end());
    const auto x = solve(m);
    const auto y = solve(flat, 3);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(x[i], y[i]);
        double sum = 0;
        for (std::size_t j = 0; j < 3; ++j)
            sum += m[i][j] * x[j];
        EXPECT_NEAR(sum, m[i][3], 1e-12);
    }
}

}  // namespace
}  // namespace weft
