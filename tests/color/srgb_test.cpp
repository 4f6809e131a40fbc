#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "engine/color/color_space.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

double exact_decode(double v) {
    const double a = std::abs(v);
    return std::copysign(a <= 0.04045 ? a / 12.92 : std::pow((a + 0.055) / 1.055, 2.4), v);
}
double exact_encode(double v) {
    const double a = std::abs(v);
    return std::copysign(a <= 0.0031308 ? a * 12.92 : 1.055 * std::pow(a, 1 / 2.4) - 0.055, v);
}

std::shared_ptr<const ColorTransform> transform(const char* from, const char* to) {
    return make_color_transform({from}, {to}).value();
}

TEST(Srgb, FollowsTheStandard) {
    for (double v = 1e-6; v < 300; v *= 1.0003) {
        const auto f = static_cast<float>(v);
        EXPECT_NEAR(srgb_to_linear(f), exact_decode(f), 2e-7 * exact_decode(f)) << v;
        EXPECT_NEAR(linear_to_srgb(f), exact_encode(f), 2e-7 * exact_encode(f)) << v;
    }
    EXPECT_EQ(srgb_to_linear(0.0f), 0.0f);
    EXPECT_EQ(srgb_to_linear(1.0f), 1.0f);
    EXPECT_EQ(linear_to_srgb(1.0f), 1.0f);
    EXPECT_NEAR(srgb_to_linear(0.5f), 0.21404114f, 1e-7);
}

TEST(Srgb, EveryCodeSurvives) {
    for (const int max : {255, 65535}) {
        for (int code = 0; code <= max; ++code) {
            const float v = static_cast<float>(code) / static_cast<float>(max);
            const float back = linear_to_srgb(srgb_to_linear(v));
            ASSERT_EQ(std::floor(back * static_cast<float>(max) + 0.5f), code);
            const float other = srgb_to_linear(linear_to_srgb(v));
            ASSERT_EQ(std::floor(other * static_cast<float>(max) + 0.5f), code);
        }
    }
}

TEST(Srgb, NeverFalls) {
    float last_decoded = -1, last_encoded = -1;
    for (std::uint32_t bits = std::bit_cast<std::uint32_t>(0.001f);
         bits < std::bit_cast<std::uint32_t>(2.0f); bits += 37) {
        const float v = std::bit_cast<float>(bits);
        // Where two segments meet, their rounding may differ by a unit in the last place.
        ASSERT_GE(srgb_to_linear(v), last_decoded * (1 - 2.4e-7f)) << v;
        ASSERT_GE(linear_to_srgb(v), last_encoded * (1 - 2.4e-7f)) << v;
        last_decoded = srgb_to_linear(v);
        last_encoded = linear_to_srgb(v);
    }
}

TEST(Srgb, ContinuesAboveOneAndMirrorsBelowZero) {
    for (const float v : {1.5f, 4.0f, 60.0f, 5000.0f, 65504.0f}) {
        EXPECT_GT(srgb_to_linear(v), v);
        EXPECT_NEAR(linear_to_srgb(srgb_to_linear(v)), v, 4e-7f * v);
    }
    for (const float v : {0.001f, 0.3f, 2.0f}) {
        EXPECT_EQ(srgb_to_linear(-v), -srgb_to_linear(v));
        EXPECT_EQ(linear_to_srgb(-v), -linear_to_srgb(v));
    }
}

TEST(Srgb, NanAndInfinityStay) {
    const float inf = std::numeric_limits<float>::infinity();
    for (const auto convert : {srgb_to_linear, linear_to_srgb}) {
        EXPECT_TRUE(std::isnan(convert(std::numeric_limits<float>::quiet_NaN())));
        EXPECT_EQ(convert(inf), inf);
        EXPECT_EQ(convert(-inf), -inf);
        EXPECT_GT(convert(std::numeric_limits<float>::min()), 0.0f);
    }
}

TEST(ColorTransform, SamePixelsForAnyNumberOfThreadsAndStride) {
    ImageF3 wide(70, 100);
    for (int i = 0; i < 70 * 100 * 3; ++i)
        wide.data()[i] = 0.0005f * static_cast<float>(i % 4000) - 0.2f;
    ImageF3 other = wide;
    set_thread_count(1);
    transform("srgb", "linear")->apply(wide.view().crop({3, 5, 61, 99}));
    set_thread_count(3);
    transform("srgb", "linear")->apply(other.view().crop({3, 5, 61, 99}));
    set_thread_count(0);
    EXPECT_EQ(wide, other);
    EXPECT_EQ(wide.at(0, 0, 0), -0.2f);  // outside the view: untouched
    EXPECT_EQ(wide.at(61, 50, 1),
              0.0005f * static_cast<float>(((50 * 70 + 61) * 3 + 1) % 4000) - 0.2f);
    EXPECT_EQ(wide.at(3, 5, 2),
              srgb_to_linear(0.0005f * static_cast<float>(((5 * 70 + 3) * 3 + 2) % 4000) - 0.2f));
}

TEST(ColorTransform, KnowsIdentity) {
    EXPECT_TRUE(transform("srgb", "srgb")->identity());
    EXPECT_TRUE(transform("linear", "linear")->identity());
    EXPECT_FALSE(transform("linear", "srgb")->identity());
}

}  // namespace
}  // namespace weft
