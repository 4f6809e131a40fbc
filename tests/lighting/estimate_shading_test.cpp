#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/lighting/shading.h"
#include "tests/lighting/lighting_scene.h"

namespace weft {
namespace {

const Recti kWall{20, 16, 300, 224};

// Deviation of ln(estimated / true light) over the small picture; the mean is the unknown albedo.
double deviation_from_light(const Shading& s, const Recti& box) {
    double sum = 0, square = 0, n = 0;
    const auto error = [&](int x, int y) {
        const int d = s.downscale;
        return std::log(s.value.at(x, y) / scene::light(x * d + d / 2, y * d + d / 2));
    };
    for (int y = box.y0 / s.downscale + 1; y < box.y1 / s.downscale - 1; ++y) {
        for (int x = box.x0 / s.downscale + 1; x < box.x1 / s.downscale - 1; ++x) {
            const double e = error(x, y);
            sum += e, square += e * e, n += 1;
        }
    }
    return std::sqrt(square / n - sum / n * (sum / n));
}

TEST(EstimateShading, SeesTheLightAndNotTheBricks) {
    for (const int d : {1, 2, 4}) {
        ShadingOptions options;
        options.downscale = d;
        const Shading s = estimate_shading(scene::plate(), scene::box_matte(kWall), options);
        ASSERT_EQ(s.value.size(), (Size{320 / d, 240 / d}));
        EXPECT_LT(deviation_from_light(s, kWall), 0.08) << "downscale " << d;
    }
}

TEST(EstimateShading, LeavesATenthOfTheBricksThatABlurLeaves) {
    // Right of the shadow, where all detail is brick. Both pictures at the plate's half size.
    const Recti lit{224, 16, 300, 224};
    const ImageF3 plate = scene::plate();
    const Matte matte = scene::box_matte(kWall);
    const Shading s = estimate_shading(plate, matte, {});
    const ImageF1 blurred = scene::gaussian_estimate(plate, matte, 5.0f);
    ImageF1 half(s.value.size());
    for (int y = 0; y < half.height(); ++y) {
        for (int x = 0; x < half.width(); ++x)
            half.at(x, y) = blurred.at(2 * x + 1, 2 * y + 1);
    }
    const Matte region =
        scene::box_matte({lit.x0 / 2, lit.y0 / 2, lit.x1 / 2, lit.y1 / 2}, half.size());
    EXPECT_LT(scene::detail_energy(s.value, region, 5),
              0.1 * scene::detail_energy(half, region, 5));
}

TEST(EstimateShading, KeepsTheShadowsEdgeSharp) {
    const Shading s = estimate_shading(scene::plate(), scene::box_matte(kWall), {});
    // The edge at x = 120 lies between small pixels 59 and 60; the step is ln 0.4 = -0.92.
    int sharp = 0, rows = 0;
    for (int y = 20; y < 100; ++y, ++rows) {
        const double step = std::log(s.value.at(62, y) / s.value.at(57, y));
        sharp += step < -0.7;
    }
    EXPECT_GE(sharp, rows * 9 / 10);
}

TEST(EstimateShading, KeepsTheShadingOfAPlainSurface) {
    // No pattern: folds of 12 px, which pattern_px would take for one, are the light.
    ImageF3 plate(scene::kSize);
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            for (int c = 0; c < 3; ++c)
                plate.at(x, y, c) = 0.3f * (1.0f + 0.08f * std::sin(static_cast<float>(x) * 0.26f));
        }
    }
    const Shading s = estimate_shading(plate, scene::box_matte(kWall), {});
    const float crest = s.value.at(63, 60), trough = s.value.at(69, 60);  // half a period apart
    EXPECT_GT(std::abs(std::log(crest / trough)), 0.08);
}

TEST(EstimateShading, TellsPaintFromShadeByItsColour) {
    // Wide red and dark blue stripes (40 px, far above pattern_px) under even light.
    ImageF3 plate(scene::kSize);
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            const bool red = (x / 40 + y / 40) % 2 == 0;
            plate.at(x, y, 0) = red ? 0.6f : 0.05f;
            plate.at(x, y, 1) = red ? 0.2f : 0.05f;
            plate.at(x, y, 2) = red ? 0.1f : 0.15f;
        }
    }
    const auto contrast = [&](bool chromaticity) {
        ShadingOptions options;
        options.chromaticity = chromaticity;
        const Shading s = estimate_shading(plate, scene::box_matte(kWall), options);
        return std::abs(std::log(s.value.at(70, 50) / s.value.at(90, 50)));
    };
    EXPECT_LT(contrast(true), 0.2f * contrast(false));
}

TEST(EstimateShading, DoesNotSeeWhatLiesOutsideTheMatte) {
    const Matte matte = scene::box_matte(kWall);
    ImageF3 other = scene::plate();
    for (int y = 0; y < other.height(); ++y) {
        for (int x = 0; x < other.width(); ++x) {
            if (matte.at(x, y)) continue;
            for (int c = 0; c < 3; ++c)
                other.at(x, y, c) = 90.0f;
        }
    }
    EXPECT_EQ(estimate_shading(scene::plate(), matte, {}).value,
              estimate_shading(other, matte, {}).value);
}

TEST(EstimateShading, RimPixelsMixedWithAnotherObjectHardlyCount) {
    const Matte matte = scene::box_matte(kWall);
    ImageF3 rim = scene::plate();
    for (int y = kWall.y0; y < kWall.y1; ++y) {
        for (int c = 0; c < 3; ++c)
            rim.at(kWall.x0, y, c) = 5.0f;
    }
    const Shading clean = estimate_shading(scene::plate(), matte, {});
    const Shading mixed = estimate_shading(rim, matte, {});
    for (int y = 20; y < 100; ++y)
        EXPECT_LT(std::abs(std::log(mixed.value.at(10, y) / clean.value.at(10, y))), 0.3) << y;
}

TEST(EstimateShading, IsFiniteAndPositiveWithNanAndInfinityInThePlate) {
    ImageF3 plate = scene::plate();
    for (int y = 40; y < 60; ++y) {
        for (int x = 240; x < 260; ++x) {
            plate.at(x, y, 1) = (x + y) % 2 ? std::numeric_limits<float>::quiet_NaN()
                                            : std::numeric_limits<float>::infinity();
        }
    }
    const Shading s = estimate_shading(plate, scene::box_matte(kWall), {});
    const Shading clean = estimate_shading(scene::plate(), scene::box_matte(kWall), {});
    for (int y = 0; y < s.value.height(); ++y) {
        for (int x = 0; x < s.value.width(); ++x) {
            ASSERT_TRUE(std::isfinite(s.value.at(x, y)) && s.value.at(x, y) > 0) << x << ' ' << y;
        }
    }
    EXPECT_NEAR(std::log(s.value.at(125, 25) / clean.value.at(125, 25)), 0, 0.1);
}

TEST(EstimateShading, IsOneForAnEmptyMatteAndPositiveForBlack) {
    const Shading none = estimate_shading(scene::plate(), Matte(scene::kSize), {});
    EXPECT_EQ(none.value, ImageF1(Size{160, 120}, 1.0f));
    const Shading black = estimate_shading(ImageF3(scene::kSize), scene::box_matte(kWall), {});
    EXPECT_GT(black.value.at(80, 60), 0);
    EXPECT_TRUE(std::isfinite(black.value.at(80, 60)));
}

TEST(EstimateShading, FollowsTheExposureAboveOne) {
    const Matte matte = scene::box_matte(kWall);
    const Shading a = estimate_shading(scene::plate(), matte, {});
    const Shading b = estimate_shading(scene::plate(80.0f), matte, {});
    for (const int x : {30, 80, 130})
        EXPECT_NEAR(b.value.at(x, 60) / a.value.at(x, 60), 80, 0.5);
}

TEST(EstimateShading, ContinuesSmoothlyOutsideTheMatte) {
    const Shading s = estimate_shading(scene::plate(), scene::box_matte(kWall), {});
    ASSERT_EQ(s.inside.at(80, 60), 255);
    ASSERT_EQ(s.inside.at(3, 60), 0);
    for (int x = 0; x < 12; ++x)
        EXPECT_LT(std::abs(std::log(s.value.at(x, 60) / s.value.at(x + 1, 60))), 0.1) << x;
}

TEST(EstimateShading, IsTheSameForAnyNumberOfThreads) {
    const Matte matte = scene::box_matte(kWall);
    set_thread_count(1);
    const Shading one = estimate_shading(scene::plate(), matte, {});
    set_thread_count(5);
    const Shading five = estimate_shading(scene::plate(), matte, {});
    set_thread_count(0);
    EXPECT_EQ(one.value, five.value);
    EXPECT_EQ(one.inside, five.inside);
}

// Sand-coloured plaster with darker and redder blotches, and the shadow of a low sun on it, which
// only the sky fills.
TEST(EstimateShading, TheBlueOfAShadowIsNoPaint) {
    ImageF3 plate(scene::kSize);
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            const float blotch = 0.1f * std::sin(0.9f * static_cast<float>(x)) *
                                 std::sin(0.7f * static_cast<float>(y));
            const bool shade = x >= 120 && x < 200;
            plate.at(x, y, 0) = 0.60f * (1 + blotch) * (shade ? 0.24f : 1.0f);
            plate.at(x, y, 1) = 0.42f * (1 + 1.5f * blotch) * (shade ? 0.31f : 1.0f);
            plate.at(x, y, 2) = 0.25f * (1 + 2.0f * blotch) * (shade ? 0.45f : 1.0f);
        }
    }
    const Shading s = estimate_shading(plate, scene::box_matte({10, 10, 310, 230}), {});
    EXPECT_NEAR(s.value.at(80, 60) / s.value.at(30, 60), 0.30f, 0.04f);
    EXPECT_NEAR(s.value.at(80, 60) / s.value.at(130, 60), 0.30f, 0.04f);
}

}  // namespace
}  // namespace weft
