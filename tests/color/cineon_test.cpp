#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/color/color_space.h"

namespace weft {
namespace {

float converted(const char* from, const char* to, float value) {
    ImageF3 image(1, 1, value);
    make_color_transform({from}, {to}).value()->apply(image.view());
    return image.at(0, 0, 1);
}

double exact(double value) {
    const auto raw = [](double code) { return std::pow(10.0, (code - 685) * 0.002 / 0.6); };
    return (raw(value * 1023) - raw(95)) / (1 - raw(95));
}

TEST(Cineon, BlackIsCode95AndWhiteCode685) {
    EXPECT_NEAR(converted("cineon", "linear", 95.0f / 1023), 0, 1e-6);
    EXPECT_NEAR(converted("cineon", "linear", 685.0f / 1023), 1, 1e-6);
    // Grey of 18 %: 685 + 300 log10(0.18 + 0.82 · 10^(-590 / 300)).
    EXPECT_NEAR(converted("linear", "cineon", 0.18f) * 1023, 467.84, 0.05);
    EXPECT_NEAR(converted("cineon", "srgb", 685.0f / 1023), 1, 1e-6);
    EXPECT_TRUE(make_color_transform({"cineon"}, {"cineon"}).value()->identity());
}

TEST(Cineon, FollowsTheFormula) {
    for (int code = 0; code <= 65535; code += 7) {
        const float v = static_cast<float>(code) / 65535.0f;
        EXPECT_NEAR(converted("cineon", "linear", v), exact(v), 1e-6 * (1 + std::abs(exact(v))));
    }
}

TEST(Cineon, EveryCodeSurvives) {
    ImageF3 image(65536, 1);
    for (int code = 0; code < 65536; ++code)
        image.at(code, 0, 0) = static_cast<float>(code) / 65535.0f;
    make_color_transform({"cineon"}, {"linear"}).value()->apply(image.view());
    make_color_transform({"linear"}, {"cineon"}).value()->apply(image.view());
    for (int code = 0; code < 65536; ++code)
        ASSERT_EQ(std::lround(image.at(code, 0, 0) * 65535.0f), code);
}

TEST(Cineon, GoesOnBeyondBothEnds) {
    float last = -std::numeric_limits<float>::infinity();
    for (float v = -0.2f; v < 1.2f; v += 0.001f) {
        const float linear = converted("cineon", "linear", v);
        EXPECT_GT(linear, last) << v;
        EXPECT_NEAR(converted("linear", "cineon", linear), v, 2e-5) << v;
        last = linear;
    }
    EXPECT_TRUE(std::isnan(converted("cineon", "linear", std::nanf(""))));
    EXPECT_TRUE(std::isinf(converted("linear", "cineon", std::numeric_limits<float>::infinity())));
}

}  // namespace
}  // namespace weft
