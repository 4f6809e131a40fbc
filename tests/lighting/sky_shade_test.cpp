// Sunlit leaves over a surface: the sky still lights what the sun does not, and bluer.
#include "engine/lighting/sky_shade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/lighting/reflectance.h"
#include "engine/lighting/shading.h"
#include "tests/lighting/lighting_scene.h"

namespace weft {
namespace {

const Recti kShadedBox{8, 8, 312, 232};
constexpr std::array<float, 3> kSun{0.78f, 0.70f, 0.60f}, kSky{0.17f, 0.20f, 0.26f};

// How much of the sun comes through, 0 to 1: blobs of some 20 px with soft edges.
float sun_at(int x, int y) {
    const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
    const float leaves = std::sin(0.21f * fx + 2 * std::sin(0.07f * fy)) +
                         std::sin(0.17f * fy + 1.5f * std::sin(0.09f * fx));
    return 1 / (1 + std::exp(-3 * leaves));
}

float light_at(int x, int y) {
    const float sun = sun_at(x, y);
    return 0.2126f * (sun * kSun[0] + kSky[0]) + 0.7152f * (sun * kSun[1] + kSky[1]) +
           0.0722f * (sun * kSun[2] + kSky[2]);
}

// `paint(x, y)`: reflectance, R, G and B. `most_grain`: to either side, by default half a per cent.
template <class Paint>
ImageF3 shaded_plate(const Paint& paint, float most_grain = 0.005f) {
    ImageF3 plate(scene::kSize);
    unsigned state = 1;
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            const std::array<float, 3> colour = paint(x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                state = state * 1664525u + 1013904223u;
                const float grain =
                    1 + 2 * most_grain * (static_cast<float>(state >> 9) / 8388608.0f - 0.5f);
                plate.pixel(x, y)[c] = grain * colour[c] * (sun_at(x, y) * kSun[c] + kSky[c]);
            }
        }
    }
    return plate;
}

// ln of the light, and where it lies.
struct Shade {
    ImageF1 ln;
    Recti box;
};

Shade shade_of(const ImageF3& plate, const Daylight& daylight) {
    const SurfaceSample sample = sample_surface(plate, scene::box_matte(kShadedBox), 1);
    return {colour_cues(sample, 28, daylight).light, sample.box};
}

double correlation_with_light(const ImageF1& ln, const Recti& box) {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0, n = 0;
    for (int y = 8; y < ln.height() - 8; ++y) {
        for (int x = 8; x < ln.width() - 8; ++x) {
            const double u = ln.at(x, y), v = std::log(light_at(x + box.x0, y + box.y0));
            a += u, b += v, aa += u * u, bb += v * v, ab += u * v, n += 1;
        }
    }
    return (ab - a * b / n) / std::sqrt((aa - a * a / n) * (bb - b * b / n));
}

std::array<float, 3> plain(int, int) {
    return {0.5f, 0.48f, 0.45f};
}

// Joints and tiles of one colour, of twice the lightness.
std::array<float, 3> tiles(int x, int y) {
    const float v = x % 20 < 4 || y % 20 < 4 ? 0.6f : 0.3f;
    return {v, 0.97f * v, 0.92f * v};
}

// Red and green tiles, of a third of the lightness or more.
std::array<float, 3> coloured(int x, int y) {
    return (x / 12 + y / 12) % 2 ? std::array<float, 3>{0.45f, 0.12f, 0.10f}
                                 : std::array<float, 3>{0.35f, 0.50f, 0.25f};
}

// The light's strength without its colour.
ImageF3 tiles_in_white_light() {
    ImageF3 plate(scene::kSize);
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x)
            std::fill_n(plate.pixel(x, y), 3, tiles(x, y)[0] * light_at(x, y));
    }
    return plate;
}

// The wide stripes of an awning, indigo on white under an even sky: darker and bluer, but by more
// than any shade.
ImageF3 awning() {
    ImageF3 plate(scene::kSize);
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            const bool indigo = x % 40 < 20;
            plate.pixel(x, y)[0] = indigo ? 0.10f : 0.8f;
            plate.pixel(x, y)[1] = indigo ? 0.14f : 0.8f;
            plate.pixel(x, y)[2] = indigo ? 0.42f : 0.8f;
        }
    }
    return plate;
}

Daylight of_the_shot() {
    return find_daylight(shaded_plate(plain));
}

TEST(Daylight, IsFoundOnShadows) {
    const Daylight daylight = of_the_shot();
    EXPECT_EQ(daylight.confidence, 1);
    // The regression of the two lights' colours on their sum's luma, over this scene.
    EXPECT_NEAR(daylight.slope, 0.237f, 0.02f);
}

TEST(Daylight, IsTheSameOnAnotherPaint) {
    const auto rust = [](int, int) { return std::array<float, 3>{0.42f, 0.20f, 0.12f}; };
    const Daylight daylight = find_daylight(shaded_plate(rust));
    EXPECT_EQ(daylight.confidence, 1);
    EXPECT_NEAR(daylight.slope, of_the_shot().slope, 0.02f);
}

TEST(Daylight, IsNotSeenWhereThereIsNone) {
    for (const ImageF3& plate : {tiles_in_white_light(), awning(), ImageF3(scene::kSize)}) {
        const Daylight none = find_daylight(plate);
        EXPECT_EQ(none.confidence, 0);
        EXPECT_EQ(none.slope, 0);
    }
}

TEST(Daylight, BearsPlatesThatAreSmallOrNotFinite) {
    EXPECT_EQ(find_daylight(ImageF3(Size{3, 2})).confidence, 0);
    ImageF3 plate = shaded_plate(plain);
    for (int y = 100; y < 140; ++y)
        plate.pixel(160, y)[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NEAR(find_daylight(plate).slope, of_the_shot().slope, 0.02f);
}

TEST(SkyShade, GivesTheLightOnAPlainWall) {
    const Shade shade = shade_of(shaded_plate(plain), of_the_shot());
    ASSERT_FALSE(shade.ln.empty());
    EXPECT_GT(correlation_with_light(shade.ln, shade.box), 0.995);
}

TEST(SkyShade, GivesItOnTilesOfOneColourAndNotTheTiles) {
    const Shade shade = shade_of(shaded_plate(tiles), of_the_shot());
    ASSERT_FALSE(shade.ln.empty());
    EXPECT_GT(correlation_with_light(shade.ln, shade.box), 0.95);
}

TEST(SkyShade, GivesItOnTilesOfTwoColours) {
    const ImageF3 plate = shaded_plate(coloured);
    const Shade shade = shade_of(plate, of_the_shot());
    ASSERT_FALSE(shade.ln.empty());
    EXPECT_GT(correlation_with_light(shade.ln, shade.box), 0.93);
    const SurfaceSample sample = sample_surface(plate, scene::box_matte(kShadedBox), 1);
    EXPECT_LT(correlation_with_light(sample.luma, sample.box), 0.85) << "the tiles are too faint";
}

// Grain hides the relation from fine colours, and a quarter of it is left at a draft's size.
TEST(SkyShade, IsFoundUnderGrain) {
    const auto stripes = [](int x, int y) {
        return (x + y / 2) / 14 % 2 ? std::array<float, 3>{0.12f, 0.2f, 0.34f}
                                    : std::array<float, 3>{0.4f, 0.38f, 0.14f};
    };
    const Shade shade = shade_of(shaded_plate(stripes, 0.3f), of_the_shot());
    ASSERT_FALSE(shade.ln.empty());
    EXPECT_GT(correlation_with_light(shade.ln, shade.box), 0.8);
}

// The shot has sun and sky, but not this surface.
TEST(SkyShade, IsNotTrustedWhereTheColoursDoNotFollow) {
    EXPECT_TRUE(shade_of(tiles_in_white_light(), of_the_shot()).ln.empty());
    EXPECT_TRUE(shade_of(awning(), of_the_shot()).ln.empty());
}

// What is decided must not pop on a frame that says something else, or nothing.
TEST(SkyShade, IsTrustedByTheFramesBefore) {
    const auto evidence_of = [](const ImageF3& plate, const Daylight& daylight) {
        const SurfaceSample sample = sample_surface(plate, scene::box_matte(kShadedBox), 1);
        return colour_cues(sample, 28, daylight).evidence;
    };
    const ImageF3 lit = shaded_plate(plain), white = tiles_in_white_light();
    Daylight daylight = of_the_shot();
    for (int frame = 0; frame < 20; ++frame)
        daylight.before = evidence_of(lit, daylight);
    EXPECT_FALSE(shade_of(white, daylight).ln.empty()) << "one frame of twenty";
    for (int frame = 0; frame < 60; ++frame)
        daylight.before = evidence_of(white, daylight);
    EXPECT_TRUE(shade_of(white, daylight).ln.empty());
}

TEST(SkyShade, IsNotSoughtWithoutDaylight) {
    EXPECT_TRUE(shade_of(shaded_plate(plain), {}).ln.empty());
}

// A single frame is enough for leaves on a plain wall, which were taken for its pattern.
TEST(SkyShade, KeepsTheLeavesOfASingleFrame) {
    ShadingOptions options;
    options.downscale = 1;
    const ImageF3 plate = shaded_plate(plain);
    const Matte matte = scene::box_matte(kShadedBox);
    const Shading shading = estimate_shading(plate, matte, options);
    ImageF1 ln(kShadedBox.size());
    for (int y = 0; y < ln.height(); ++y) {
        for (int x = 0; x < ln.width(); ++x)
            ln.at(x, y) = std::log(shading.value.at(x + kShadedBox.x0, y + kShadedBox.y0));
    }
    EXPECT_GT(correlation_with_light(ln, kShadedBox), 0.985);
    options.chromaticity = false;
    const Shading without = estimate_shading(plate, matte, options);
    for (int y = 0; y < ln.height(); ++y) {
        for (int x = 0; x < ln.width(); ++x)
            ln.at(x, y) = std::log(without.value.at(x + kShadedBox.x0, y + kShadedBox.y0));
    }
    EXPECT_LT(correlation_with_light(ln, kShadedBox), 0.985) << "the scene must need the colour";
}

}  // namespace
}  // namespace weft
