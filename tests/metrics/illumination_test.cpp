#include "engine/metrics/illumination.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

TEST(Illumination, MeanValueIsTheLargestChannelInsideTheMatte) {
    ImageF3 p(4, 2, 0.9f);
    p.at(1, 0, 0) = 0.2f;
    p.at(1, 0, 1) = 0.6f;
    p.at(1, 0, 2) = 0.4f;
    p.at(2, 0, 1) = std::numeric_limits<float>::quiet_NaN();
    Matte m(4, 2, 200);  // Half-covered pixels do not count.
    m.at(1, 0) = 255;
    m.at(2, 0) = 255;
    EXPECT_NEAR(*mean_value(p, m), 0.6 * 255, 1e-4);
    EXPECT_FALSE(mean_value(p, Matte(4, 2, 0)).has_value());
}

TEST(Illumination, VarianceOfAKnownFlicker) {
    IlluminationVariance v;
    for (int t = 0; t < 40; ++t)
        v.add(t % 2 == 0 ? 130.0 : 110.0, 80.0);
    EXPECT_NEAR(v.tiv(), 100.0, 1e-9);
    EXPECT_NEAR(v.source_tiv(), 0.0, 1e-9);
    EXPECT_NEAR(v.tiv_relative(), 100.0 / (120.0 * 120.0), 1e-9);
}

TEST(Illumination, RelativeVarianceForgivesLightThatReallyChanges) {
    IlluminationVariance follows;
    IlluminationVariance ignores;
    for (int t = 0; t < 30; ++t) {
        const double light = 1.0 + 0.35 * t / 29.0;
        follows.add(60 * light, 100 * light);
        ignores.add(60, 100 * light);
    }
    EXPECT_GT(follows.tiv(), 30);
    EXPECT_NEAR(follows.tiv_relative(), 0, 1e-12);
    EXPECT_NEAR(ignores.tiv(), 0, 1e-9);
    EXPECT_GT(ignores.tiv_relative(), 0.005);
}

}  // namespace
}  // namespace weft
