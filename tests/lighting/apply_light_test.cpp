#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/color/color_space.h"
#include "engine/core/parallel.h"
#include "engine/lighting/shading.h"
#include "tests/lighting/lighting_scene.h"

namespace weft {
namespace {

constexpr Size kSize{64, 48};

Shading even(float value, Size full = kSize) {
    return {ImageF1(Size{(full.width + 1) / 2, (full.height + 1) / 2}, value), 2, full, {}};
}

ImageF3 checker(float dark, float bright) {
    ImageF3 t(kSize);
    for (int y = 0; y < t.height(); ++y) {
        for (int x = 0; x < t.width(); ++x) {
            const float v = (x + y) % 2 ? bright : dark;
            t.at(x, y, 0) = v, t.at(x, y, 1) = 0.5f * v, t.at(x, y, 2) = 0.25f * v;
        }
    }
    return t;
}

float display_value(const ImageF3& t, int x, int y) {
    return linear_to_srgb(std::max({t.at(x, y, 0), t.at(x, y, 1), t.at(x, y, 2)}));
}

TEST(ApplyLight, GainFollowsTheFormulaAndItsLimits) {
    const Matte matte(kSize, 255);
    const auto lit = [&](float shading, float strength) {
        ImageF3 t = checker(2.0f, 2.0f);  // above 1: scene-linear
        apply_light(t, {0, 0}, matte, even(shading), 0.5f, {LightForm::kGain, strength});
        EXPECT_FLOAT_EQ(t.at(9, 9, 1) / t.at(9, 9, 0), 0.5f);
        return t.at(9, 9, 0);
    };
    EXPECT_FLOAT_EQ(lit(0.25f, 1.0f), 1.0f);
    EXPECT_FLOAT_EQ(lit(0.25f, 0.5f), 1.5f);
    EXPECT_FLOAT_EQ(lit(2.0f, 1.0f), 8.0f);
    EXPECT_FLOAT_EQ(lit(500.0f, 1.0f), 16.0f);
    EXPECT_FLOAT_EQ(lit(0.001f, 1.0f), 0.25f);
}

TEST(ApplyLight, ChangesNoBitWhereThereIsNothingToDo) {
    const ImageF3 before = checker(0.1f, 0.7f);
    const Matte matte(kSize, 255);
    ImageF3 t = before;
    apply_light(t, {0, 0}, matte, even(0.3f), 0.7f, {LightForm::kGain, 0.0f});
    EXPECT_EQ(t, before);
    apply_light(t, {0, 0}, matte, even(0.5f), 0.5f, {LightForm::kGain, 1.0f});
    EXPECT_EQ(t, before);
    apply_light(t, {0, 0}, Matte(kSize, 0), even(0.5f), 0.1f, {LightForm::kGain, 1.0f});
    EXPECT_EQ(t, before);
    apply_light(t, {0, 0}, matte, even(0.5f), std::numeric_limits<float>::quiet_NaN(), {});
    EXPECT_EQ(t, before);
}

TEST(ApplyLight, TakesTheShadingAtTheOrigin) {
    // A shading that grows with x: the patch at x = 40 must get the light of the plate's x = 40.
    Shading s = even(1.0f);
    for (int y = 0; y < s.value.height(); ++y) {
        for (int x = 0; x < s.value.width(); ++x)
            s.value.at(x, y) = 2.0f * static_cast<float>(x) + 1.0f;
    }
    ImageF3 patch(10, 10, 1.0f);
    apply_light(patch, {40, 20}, Matte(10, 10, 255), s, 40.0f, {});
    // Small pixel i lies at plate x = 2 i + 1 and holds 2 i + 1, so plate pixel 43 holds 43.5.
    EXPECT_NEAR(patch.at(3, 5, 0), 43.5f / 40.0f, 1e-5f);
}

TEST(ApplyLight, LiteralErasesTheTextureAtFullStrength) {
    ImageF3 t = checker(0.1f, 0.6f);
    apply_light(t, {0, 0}, Matte(kSize, 255), even(0.3f), 1.0f, {LightForm::kLiteral, 1.0f});
    EXPECT_NEAR(display_value(t, 20, 20), linear_to_srgb(0.3f), 1e-4f);
    EXPECT_NEAR(display_value(t, 21, 20), linear_to_srgb(0.3f), 1e-4f);
}

TEST(ApplyLight, LiteralMixesDisplayValues) {
    ImageF3 t = checker(0.1f, 0.6f);
    apply_light(t, {0, 0}, Matte(kSize, 255), even(0.3f), 1.0f, {LightForm::kLiteral, 0.25f});
    EXPECT_NEAR(display_value(t, 20, 20),
                0.25f * linear_to_srgb(0.3f) + 0.75f * linear_to_srgb(0.1f), 1e-4f);
}

TEST(ApplyLight, DetailKeepsTheTexturesContrast) {
    const ImageF3 before = checker(0.1f, 0.6f);
    ImageF3 t = before;
    apply_light(t, {0, 0}, Matte(kSize, 255), even(0.2f), 1.0f, {LightForm::kDetail, 1.0f});
    const float ratio = display_value(t, 31, 20) / display_value(t, 30, 20);
    EXPECT_NEAR(ratio, display_value(before, 31, 20) / display_value(before, 30, 20), 0.02f);
    // And its base becomes the light.
    const float base = 0.5f * (display_value(t, 31, 20) + display_value(t, 30, 20));
    EXPECT_NEAR(base, linear_to_srgb(0.2f), 0.02f);
}

TEST(ApplyLight, NanStaysWhereItIs) {
    for (const LightForm form : {LightForm::kGain, LightForm::kDetail, LightForm::kLiteral}) {
        ImageF3 t = checker(0.1f, 0.6f);
        t.at(10, 10, 0) = t.at(10, 10, 1) = t.at(10, 10, 2) =
            std::numeric_limits<float>::quiet_NaN();
        apply_light(t, {0, 0}, Matte(kSize, 255), even(0.2f), 0.4f, {form, 1.0f});
        for (int y = 0; y < t.height(); ++y) {
            for (int x = 0; x < t.width(); ++x)
                ASSERT_EQ(std::isfinite(t.at(x, y, 2)), x != 10 || y != 10) << x << ' ' << y;
        }
    }
}

TEST(ApplyLight, IsTheSameForAnyNumberOfThreads) {
    Shading s = even(1.0f);
    for (int x = 0; x < s.value.width(); ++x)
        s.value.at(x, 7) = 0.3f;
    for (const LightForm form : {LightForm::kGain, LightForm::kDetail, LightForm::kLiteral}) {
        ImageF3 one = checker(0.1f, 0.6f), many = one;
        set_thread_count(1);
        apply_light(one, {0, 0}, Matte(kSize, 200), s, 0.8f, {form, 0.7f});
        set_thread_count(4);
        apply_light(many, {0, 0}, Matte(kSize, 200), s, 0.8f, {form, 0.7f});
        set_thread_count(0);
        EXPECT_EQ(one, many);
    }
}

TEST(MedianShading, IsTakenInsideTheMatteOnly) {
    Shading s = even(9.0f);
    for (int y = 4; y < 12; ++y) {
        for (int x = 4; x < 12; ++x)
            s.value.at(x, y) = x < 7 ? 0.25f : 0.5f;
    }
    EXPECT_EQ(median_shading(s, scene::box_matte({8, 8, 24, 24}, kSize)), 0.5f);
    EXPECT_EQ(median_shading(s, Matte(kSize)), 1.0f);
}

TEST(ShadingFromImage, StretchesThePictureOverTheBox) {
    ImageF3 picture(2, 1, 0.2f);
    for (int c = 0; c < 3; ++c)
        picture.at(1, 0, c) = 3.0f;
    const Shading s = shading_from_image(picture, {16, 8, 48, 40}, kSize);
    EXPECT_EQ(s.full, kSize);
    EXPECT_NEAR(s.value.at(10, 10), 0.2f, 1e-4f);
    EXPECT_NEAR(s.value.at(22, 18), 3.0f, 1e-4f);
    EXPECT_NEAR(s.value.at(0, 0), 0.2f, 1e-4f);
    EXPECT_NEAR(s.value.at(31, 23), 3.0f, 1e-4f);
}

TEST(ShadingFromImage, FillsNanAndStaysAboveZero) {
    ImageF3 picture(8, 8, 0.0f);
    picture.at(3, 3, 0) = std::numeric_limits<float>::quiet_NaN();
    const Shading s = shading_from_image(picture, {0, 0, 64, 48}, kSize);
    for (int y = 0; y < s.value.height(); ++y) {
        for (int x = 0; x < s.value.width(); ++x)
            ASSERT_GT(s.value.at(x, y), 0.0f);
    }
}

}  // namespace
}  // namespace weft
