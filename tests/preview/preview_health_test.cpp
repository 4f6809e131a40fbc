#include "app/preview/preview_health.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

constexpr Size kHealthFrame{64, 48};

LatticeField field(float gradient) {
    LatticeField out(kHealthFrame, 8);
    for (int j = 0; j < out.nodes().height(); ++j)
        for (int i = 0; i < out.nodes().width(); ++i)
            out.set_node(i, j, {gradient * out.node_position(i, j).x, 0});
    return out;
}

TEST(PreviewHealth, StretchIsOneWhereNothingIsDrawnOut) {
    const Matte all(kHealthFrame.width, kHealthFrame.height, 255);
    EXPECT_NEAR(mean_stretch(field(0), all), 1, 1e-3);
    // By the root of the area: twice as wide and as high as before is 2.
    EXPECT_NEAR(mean_stretch(field(1), all), std::sqrt(2.0), 0.01) << "twice as wide";
    EXPECT_NEAR(mean_stretch(field(-0.5f), all), std::sqrt(2.0), 0.01) << "half as wide";
    EXPECT_LT(mean_stretch(field(0), Matte(kHealthFrame.width, kHealthFrame.height, 0)), 0);
}

TEST(PreviewHealth, DriftIsNoneForTheSamePatternAndGrowsWithTheDifference) {
    const Matte all(kHealthFrame.width, kHealthFrame.height, 255);
    ImageF1 pattern(kHealthFrame.width, kHealthFrame.height),
        other(kHealthFrame.width, kHealthFrame.height);
    for (int y = 0; y < kHealthFrame.height; ++y)
        for (int x = 0; x < kHealthFrame.width; ++x) {
            pattern.at(x, y) = (x / 4 + y / 4) % 2 == 0 ? 0.8f : 1.2f;
            other.at(x, y) = (x / 4 + y / 4) % 2 == 0 ? 1.2f : 0.8f;
        }
    EXPECT_NEAR(pattern_drift(pattern, pattern, field(0), all, 1), 0, 0.01);
    EXPECT_GT(pattern_drift(other, pattern, field(0), all, 1), 0.2);
    EXPECT_LT(pattern_drift(pattern, pattern, field(0),
                            Matte(kHealthFrame.width, kHealthFrame.height, 0), 1),
              0);
}

}  // namespace
}  // namespace weft
