#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "engine/color/color_space.h"
#include "engine/composite/composite.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// An old surface on the left, something else on the right, a soft edge of `width` px at x = 80.
struct Scene {
    ImageF3 old_surface, surroundings, texture, plate, truth, plain_mix;
    Matte matte;
};

using Colour = std::function<float(int x, int y, int c)>;

Scene make_scene(Size size, float width, const Colour& old_surface, const Colour& surroundings,
                 float matte_width = 0) {
    Scene s{ImageF3(size), ImageF3(size), ImageF3(size), ImageF3(size),
            ImageF3(size), ImageF3(size), Matte(size)};
    if (matte_width == 0) matte_width = width;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float off =
                static_cast<float>(x) - 80.0f + 6.0f * std::sin(0.1f * static_cast<float>(y));
            const float given = std::clamp(0.5f - off / matte_width, 0.0f, 1.0f);
            s.matte.at(x, y) = static_cast<std::uint8_t>(given * 255.0f + 0.5f);
            const float m = matte_width == width ? static_cast<float>(s.matte.at(x, y)) / 255.0f
                                                 : std::clamp(0.5f - off / width, 0.0f, 1.0f);
            for (int c = 0; c < 3; ++c) {
                const float b = old_surface(x, y, c), g = surroundings(x, y, c);
                const float t = c == 0 ? 0.7f : 0.2f;
                s.texture.at(x, y, c) = t;
                s.plate.at(x, y, c) = m * b + (1 - m) * g;
                s.truth.at(x, y, c) = m * t + (1 - m) * g;
                s.plain_mix.at(x, y, c) = given * t + (1 - given) * s.plate.at(x, y, c);
            }
        }
    }
    return s;
}

ImageF3 replaced(const Scene& s) {
    ImageF3 out = s.plate;
    composite_over(out, s.plate, unmix_surface(s.plate, s.matte), s.matte, s.texture);
    return out;
}

double mean_error_in_soft(const ImageF3& a, const ImageF3& b, const Matte& matte) {
    double sum = 0, n = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            if (matte.at(x, y) == 0 || matte.at(x, y) == 255) continue;
            for (int c = 0; c < 3; ++c)
                sum += std::abs(a.at(x, y, c) - b.at(x, y, c)), n += 1;
        }
    }
    return n > 0 ? sum / n : 0;
}

const Colour kBlue = [](int x, int y, int c) {
    return (c == 2 ? 0.6f : 0.1f) + 0.0006f * static_cast<float>(x) +
           0.0003f * static_cast<float>(y);
};
const Colour kGreen = [](int x, int y, int c) {
    return (c == 1 ? 0.5f : 0.15f) + 0.0004f * static_cast<float>(y) -
           0.0003f * static_cast<float>(x);
};
const Colour kBricks = [](int x, int y, int c) {
    const bool mortar = y % 10 < 3 || (x + (y / 10 % 2) * 12) % 24 < 3;
    return mortar ? 0.5f : c == 0 ? 0.3f : 0.1f;
};

class SoftEdge : public testing::TestWithParam<float> {};

TEST_P(SoftEdge, OfAPlainSurfaceIsUnmixed) {
    const Scene s = make_scene({160, 120}, GetParam(), kBlue, kGreen);
    const double error = mean_error_in_soft(replaced(s), s.truth, s.matte);
    EXPECT_LT(error, 0.012);
    EXPECT_LT(error, 0.15 * mean_error_in_soft(s.plain_mix, s.truth, s.matte));
}

TEST_P(SoftEdge, OfAPatternedSurfaceIsMostlyUnmixed) {
    const Scene s = make_scene({160, 120}, GetParam(), kBricks, kGreen);
    const double error = mean_error_in_soft(replaced(s), s.truth, s.matte);
    EXPECT_LT(error, 0.035);
    EXPECT_LT(error, 0.35 * mean_error_in_soft(s.plain_mix, s.truth, s.matte));
}

INSTANTIATE_TEST_SUITE_P(Widths, SoftEdge, testing::Values(2.0f, 8.0f, 30.0f));

TEST(UnmixSurface, AMatteSofterThanThePlateMakesNoFringe) {
    // The plate's edge is 1 px wide, the matte's 5: the literal formula would leave light and dark.
    const Scene s = make_scene({160, 120}, 1.0f, kBlue, kGreen, 5.0f);
    const ImageF3 out = replaced(s);
    for (int y = 10; y < 110; ++y) {
        for (int x = 0; x < 160; ++x) {
            const int m = s.matte.at(x, y);
            if (m == 0 || m == 255) continue;
            for (int c = 0; c < 3; ++c) {
                const float t = s.texture.at(x, y, c), g = kGreen(x, y, c);
                ASSERT_GT(out.at(x, y, c), std::min(t, g) - 0.08f) << x << ' ' << y << ' ' << m;
                ASSERT_LT(out.at(x, y, c), std::max(t, g) + 0.08f) << x << ' ' << y << ' ' << m;
            }
        }
    }
}

TEST(UnmixSurface, EqualsThePlateInsideAndIsZeroOutside) {
    const Scene s = make_scene({160, 120}, 8, kBricks, kGreen);
    const ImageF3 surface = unmix_surface(s.plate, s.matte);
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            for (int c = 0; c < 3; ++c) {
                if (s.matte.at(x, y) == 255) {
                    ASSERT_EQ(surface.at(x, y, c), s.plate.at(x, y, c));
                } else if (s.matte.at(x, y) == 0) {
                    ASSERT_EQ(surface.at(x, y, c), 0.0f);
                }
            }
        }
    }
}

TEST(UnmixSurface, LeavesNanAndInfinityOutAndFillsThem) {
    Scene s = make_scene({160, 120}, 8, kBlue, kGreen);
    for (int y = 30; y < 36; ++y) {
        for (int x = 60; x < 100; ++x)
            s.plate.at(x, y, x % 3) = x % 2 ? kNan : kInfinity;
    }
    const ImageF3 surface = unmix_surface(s.plate, s.matte);
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            for (int c = 0; c < 3; ++c)
                ASSERT_TRUE(std::isfinite(surface.at(x, y, c)));
        }
    }
    EXPECT_NEAR(surface.at(62, 32, 2), kBlue(62, 32, 2), 0.03f);
}

TEST(UnmixSurface, WithoutAnySurePixelMakesThePlainMix) {
    ImageF3 plate(40, 30, 0.4f);
    const Matte half(Size{40, 30}, 128);
    ImageF3 out = plate;
    composite_over(out, plate, unmix_surface(plate, half), half, ImageF3(40, 30, 0.8f));
    EXPECT_NEAR(out.at(20, 15, 0), 0.4f + 128.0f / 255.0f * 0.4f, 1e-5f);
}

TEST(UnmixSurface, IsTheSameForAnyNumberOfThreads) {
    const Scene s = make_scene({160, 120}, 30, kBricks, kGreen);
    set_thread_count(1);
    const ImageF3 one = unmix_surface(s.plate, s.matte);
    set_thread_count(4);
    const ImageF3 many = unmix_surface(s.plate, s.matte);
    set_thread_count(0);
    EXPECT_EQ(one, many);
}

TEST(CompositeOver, CopiesEveryBitOutsideAndTheTextureInside) {
    Scene s = make_scene({160, 120}, 8, kBlue, kGreen);
    s.plate.at(150, 20, 0) = kNan;
    s.plate.at(151, 20, 0) = -kInfinity;
    s.plate.at(5, 20, 1) = kNan;
    const ImageF3 out = replaced(s);
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            if (s.matte.at(x, y) == 0) {
                ASSERT_EQ(std::memcmp(out.pixel(x, y), s.plate.pixel(x, y), 3 * sizeof(float)), 0);
            } else if (s.matte.at(x, y) == 255) {
                ASSERT_EQ(std::memcmp(out.pixel(x, y), s.texture.pixel(x, y), 3 * sizeof(float)),
                          0);
            }
        }
    }
}

TEST(CompositeOver, MakesNoNegativeLightAndKeepsHighValues) {
    const Matte half(Size{3, 1}, 128);
    ImageF3 plate(3, 1, 0.1f), surface(3, 1, 0.9f), texture(3, 1, 0.0f);
    plate.at(1, 0, 0) = -0.2f;  // already out of gamut: stays what the formula says
    plate.at(2, 0, 0) = 40.0f;
    ImageF3 out = plate;
    composite_over(out, plate, surface, half, texture);
    EXPECT_EQ(out.at(0, 0, 0), 0.0f);
    EXPECT_LT(out.at(1, 0, 0), -0.2f);
    EXPECT_NEAR(out.at(2, 0, 0), 40.0f - 128.0f / 255.0f * 0.9f, 1e-4f);
}

TEST(CompositeOver, TakesTheTextureWhereThePlateIsNotANumber) {
    const Matte soft(Size{2, 1}, 60);
    ImageF3 plate(2, 1, kNan), out = plate;
    plate.at(1, 0, 1) = kInfinity;
    composite_over(out, plate, ImageF3(2, 1, 0.2f), soft, ImageF3(2, 1, 0.6f));
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(out.at(0, 0, c), 0.6f);
    EXPECT_EQ(out.at(1, 0, 1), 0.6f);
}

TEST(RollOff, ItsKneeBringsThePeakBelowWhite) {
    EXPECT_EQ(roll_off_knee(0.3f), 0.9f);
    EXPECT_EQ(roll_off_knee(1), 0.9f);
    EXPECT_EQ(roll_off_knee(40), 0.5f);
    for (const float peak : {1.2f, 1.5f, 2.5f, 4.0f}) {
        ImageF3 rgb(2, 1, peak);
        rgb.at(0, 0, 0) = rgb.at(0, 0, 1) = rgb.at(0, 0, 2) = 0.8f * peak;
        EXPECT_EQ(roll_off(rgb, Matte(Size{2, 1}, 255), roll_off_knee(peak)),
                  0.8f * peak > 1 ? 2 : 1);
        EXPECT_NEAR(255 * linear_to_srgb(rgb.at(1, 0, 0)), 250, 0.3f) << peak;
        EXPECT_LT(255 * linear_to_srgb(rgb.at(0, 0, 0)), 249) << peak << ": steps are kept";
    }
}

TEST(RollOff, IsTheIdentityUpToTheKneeAndStaysBelowOne) {
    ImageF3 rgb(4, 1, 0.5f);
    rgb.at(1, 0, 0) = 0.9f;
    rgb.at(2, 0, 0) = 1.4f, rgb.at(2, 0, 1) = 0.7f, rgb.at(2, 0, 2) = 0.35f;
    rgb.at(3, 0, 0) = 500.0f;
    const ImageF3 before = rgb;
    EXPECT_EQ(roll_off(rgb, Matte(Size{4, 1}, 255)), 2);
    EXPECT_EQ(std::memcmp(rgb.pixel(0, 0), before.pixel(0, 0), 6 * sizeof(float)), 0);
    EXPECT_GT(rgb.at(2, 0, 0), 0.9f);
    EXPECT_LT(rgb.at(2, 0, 0), 1.0f);
    EXPECT_NEAR(rgb.at(2, 0, 1) / rgb.at(2, 0, 0), 0.5f, 1e-5f);
    EXPECT_LT(rgb.at(2, 0, 0), rgb.at(3, 0, 0));
    EXPECT_LE(rgb.at(3, 0, 0), 1.0f);
}

TEST(RollOff, DoesNotTouchThePlateOutsideTheMatte) {
    ImageF3 rgb(2, 1, 3.0f);
    Matte matte(Size{2, 1}, 0);
    matte.at(1, 0) = 1;
    EXPECT_EQ(roll_off(rgb, matte), 1);
    EXPECT_EQ(rgb.at(0, 0, 0), 3.0f);
    EXPECT_NEAR(rgb.at(1, 0, 0), 3.0f, 0.02f);  // nearly all plate
}

TEST(RollOff, MakesInfinityWhiteAndNanBlack) {
    ImageF3 rgb(2, 1, kInfinity);
    rgb.at(1, 0, 0) = kNan, rgb.at(1, 0, 1) = 2.0f, rgb.at(1, 0, 2) = 0.1f;
    EXPECT_EQ(roll_off(rgb, Matte(Size{2, 1}, 255)), 2);
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(rgb.at(0, 0, c), 1.0f);
    EXPECT_EQ(rgb.at(1, 0, 0), 0.0f);
    EXPECT_LT(rgb.at(1, 0, 1), 1.0f);
}

// What is shown of a new surface may differ from what the old one covers.
TEST(UnmixSurface, AnEdgeThatIsMovedTakesTheOldSurfaceAlong) {
    const Scene s = make_scene(
        {160, 60}, 8, [](int, int, int) { return 0.1f; }, [](int, int, int) { return 0.8f; });
    EXPECT_EQ(unmix_surface(s.plate, s.matte, s.matte), unmix_surface(s.plate, s.matte));
    Matte shown(s.matte.size());
    constexpr int kShift = 5;
    for (int y = 0; y < shown.height(); ++y)
        for (int x = 0; x < shown.width(); ++x)
            shown.at(x, y) = s.matte.at(std::max(0, x - kShift), y);
    ImageF3 out = s.plate;
    composite_over(out, s.plate, unmix_surface(s.plate, s.matte, shown), shown, s.texture);
    for (int y = 0; y < shown.height(); ++y) {
        for (int x = 0; x < shown.width(); ++x) {
            const float e = static_cast<float>(shown.at(x, y)) / 255.0f;
            for (int c = 0; c < 3; ++c) {
                const float wanted = e * s.texture.at(x, y, c) + (1 - e) * 0.8f;
                if (shown.at(x, y) <= s.matte.at(x, y)) continue;
                ASSERT_NEAR(out.at(x, y, c), wanted, 0.03f) << x << ' ' << y;
            }
        }
    }
}

}  // namespace
}  // namespace weft
