#include "engine/color/grade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/core/luma.h"

namespace weft {
namespace {

ImageF3 colours() {
    ImageF3 out(4, 1);
    const float values[] = {0.18f, 0.18f, 0.18f, 0.6f, 0.2f, 0.05f, 0, 0, 0, 2.5f, 1.5f, 0.1f};
    std::copy(std::begin(values), std::end(values), out.data());
    return out;
}

ImageF3 graded(const Grade& grade) {
    ImageF3 out = colours();
    apply_grade(out, Matte(out.size(), 255), grade);
    return out;
}

TEST(Grade, ADefaultChangesNoBit) {
    const ImageF3 before = colours(), after = graded({});
    EXPECT_EQ(std::memcmp(before.data(), after.data(), before.size_bytes()), 0);
}

TEST(Grade, ExposureMultiplyAndOffsetAreLinear) {
    const ImageF3 before = colours();
    const ImageF3 after =
        graded({.exposure = 1, .multiply = {0.5f, 1, 2}, .offset = {0.01f, 0, -5}});
    for (int x = 0; x < before.width(); ++x) {
        EXPECT_NEAR(after.at(x, 0, 0), before.at(x, 0, 0) + 0.01f, 1e-6f);
        EXPECT_NEAR(after.at(x, 0, 1), 2 * before.at(x, 0, 1), 1e-6f);
        EXPECT_EQ(after.at(x, 0, 2), 0.0f) << "never below 0";
    }
}

TEST(Grade, ContrastTurnsAboutMiddleGreyAndGammaKeepsBlackAndWhite) {
    const ImageF3 hard = graded({.contrast = 1.5f}), bright = graded({.gamma = 2});
    EXPECT_NEAR(hard.at(0, 0, 0), 0.18f, 1e-6f);
    EXPECT_GT(hard.at(1, 0, 0), 0.6f);
    EXPECT_LT(hard.at(1, 0, 2), 0.05f);
    EXPECT_NEAR(bright.at(0, 0, 0), std::sqrt(0.18f), 1e-6f);
    EXPECT_EQ(bright.at(2, 0, 0), 0.0f);
}

TEST(Grade, SaturationAndHueKeepTheLuminance) {
    const ImageF3 before = colours();
    for (const Grade& grade : {Grade{.saturation = 0}, Grade{.saturation = 0.5f, .hue_deg = 35}}) {
        const ImageF3 after = graded(grade);
        for (int x = 0; x < 2; ++x)
            EXPECT_NEAR(luma_709(after.pixel(x, 0)), luma_709(before.pixel(x, 0)), 1e-5f);
    }
    const ImageF3 grey = graded({.saturation = 0});
    EXPECT_NEAR(grey.at(1, 0, 0), grey.at(1, 0, 2), 1e-6f);
    const ImageF3 turned = graded({.hue_deg = 120}), whole = graded({.hue_deg = 360});
    EXPECT_GT(turned.at(1, 0, 1), turned.at(1, 0, 0)) << "orange turns towards green";
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(whole.at(1, 0, c), before.at(1, 0, c), 1e-5f);
}

TEST(Grade, TemperatureFollowsDaylight) {
    // From 6,504 K to 5,000 K: 46.2 mired; D50 in linear sRGB is (1.176, 0.976, 0.721).
    const auto gain = temperature_gain(46.2f);
    EXPECT_NEAR(gain[0] / gain[1], 1.176f / 0.976f, 0.02f);
    EXPECT_NEAR(gain[2] / gain[1], 0.721f / 0.976f, 0.03f);
    EXPECT_NEAR(luma_709(gain.data()), 1.0f, 1e-5f);
    EXPECT_LT(temperature_gain(-46.2f)[0], 1.0f);
}

TEST(Grade, LeavesWhatIsOutsideOrNotFinite) {
    ImageF3 picture = colours();
    picture.at(1, 0, 1) = std::numeric_limits<float>::quiet_NaN();
    Matte matte(picture.size(), 255);
    matte.at(0, 0) = 0;
    apply_grade(picture, matte, {.exposure = 2, .saturation = 0.5f});
    EXPECT_EQ(picture.at(0, 0, 0), 0.18f);
    EXPECT_EQ(picture.at(1, 0, 0), 0.6f);
    EXPECT_GT(picture.at(3, 0, 0), 2.5f);
}

}  // namespace
}  // namespace weft
