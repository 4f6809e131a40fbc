// Gloss, told from paint by its colour.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "engine/core/luma.h"
#include "engine/core/rng.h"
#include "engine/lighting/highlights.h"

namespace weft {
namespace {

constexpr int kGlossSide = 96;
constexpr std::array<float, 3> kWhite{0, 0, 0};  // ln
constexpr std::array<float, 3> kGreen{0.03f, 0.3f, 0.12f}, kRed{0.35f, 0.04f, 0.04f};

// A highlight's luminance.
float mirrored_at(int x, int y) {
    const float u = static_cast<float>(x - 40) / 12, v = static_cast<float>(y - 30) / 8;
    return 0.5f * std::exp(-u * u - v * v);
}

float shade_at(int x) {
    return 0.3f + 0.7f * static_cast<float>(x) / kGlossSide;
}

// A surface of `paint` (by place) under a light that falls off, with a highlight and some noise.
ImageF3 glossy(const std::function<const std::array<float, 3>&(int x)>& paint) {
    ImageF3 plate(kGlossSide, kGlossSide);
    Rng rng(3);
    for (int y = 0; y < kGlossSide; ++y)
        for (int x = 0; x < kGlossSide; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                plate.pixel(x, y)[c] = paint(x)[c] * shade_at(x) + mirrored_at(x, y) +
                                       0.002f * static_cast<float>(rng.uniform());
    return plate;
}

const std::array<float, 3>& green(int /*x*/) {
    return kGreen;
}

Shading flat_light(float value) {
    return {ImageF1(kGlossSide, kGlossSide, value), 1, {kGlossSide, kGlossSide}, {}};
}

const Matte kGlossMatte(Size{kGlossSide, kGlossSide}, 255);

TEST(Highlights, OfACarAreWhatItMirrors) {
    const ImageF3 plate = glossy(green);
    const SurfaceColours colours = surface_colours(plate, kGlossMatte, kWhite);
    EXPECT_GT(colours.confidence, 0.95f);
    // On black nothing is seen but gloss.
    ImageF3 texture(kGlossSide, kGlossSide, 0.0f);
    add_highlights(texture, find_highlights({0, 0}, plate, kGlossMatte, flat_light(1), colours, {},
                                            {1, 0, kGlossSide}));
    for (const auto [x, y] : {std::array{40, 30}, {46, 34}, {30, 30}, {80, 80}, {8, 60}})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(texture.at(x, y, c), mirrored_at(x, y), 0.03f) << x << " " << y;
}

TEST(Highlights, LightIsNotPutOnTwice) {
    const ImageF3 plate = glossy(green);
    const SurfaceColours colours = surface_colours(plate, kGlossMatte, kWhite);
    // A texture whose light has the highlight in it, as an estimate from the plate may have.
    ImageF3 texture(kGlossSide, kGlossSide);
    for (int y = 0; y < kGlossSide; ++y)
        for (int x = 0; x < kGlossSide; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                texture.pixel(x, y)[c] = plate.pixel(x, y)[1];
    const float before = texture.at(40, 30, 1);
    add_highlights(texture, find_highlights({0, 0}, plate, kGlossMatte, flat_light(1), colours, {},
                                            {1, 0, kGlossSide}));
    EXPECT_LT(texture.at(40, 30, 1), 1.25f * before);
    EXPECT_NEAR(texture.at(80, 80, 1), kGreen[1] * shade_at(80), 0.05f);
}

TEST(Highlights, OfAGreySurfaceAreItsExcess) {
    ImageF3 plate(kGlossSide, kGlossSide, 0.2f);
    for (int c = 0; c < 3; ++c)
        plate.at(10, 10, c) = 3.0f;
    const SurfaceColours colours = surface_colours(plate, kGlossMatte, kWhite);
    EXPECT_EQ(colours.confidence, 0.0f);
    ImageF3 texture(kGlossSide, kGlossSide, 0.1f);
    add_highlights(texture, find_highlights({0, 0}, plate, kGlossMatte, flat_light(1), colours, {},
                                            {1, 0, kGlossSide}));
    EXPECT_NEAR(texture.at(10, 10, 1), 0.1f + 3.0f - 1.15f * 0.2f, 1e-3f);
    EXPECT_EQ(texture.at(30, 30, 1), 0.1f);
}

TEST(Highlights, SeveralPaintsAreNotToldFromGloss) {
    const ImageF3 plate = glossy(
        [](int x) -> const std::array<float, 3>& { return x / 12 % 2 == 0 ? kGreen : kRed; });
    EXPECT_LT(surface_colours(plate, kGlossMatte, kWhite).confidence, 0.05f);
}

TEST(Highlights, RoughnessSpreadsThem) {
    const ImageF3 plate = glossy(green);
    const SurfaceColours colours = surface_colours(plate, kGlossMatte, kWhite);
    const auto gloss = [&](float roughness) {
        ImageF3 texture(kGlossSide, kGlossSide, 0.0f);
        add_highlights(texture, find_highlights({0, 0}, plate, kGlossMatte, flat_light(1), colours,
                                                {}, {1, roughness, 20 * kGlossSide}));
        return texture;
    };
    const ImageF3 sharp = gloss(0), rough = gloss(0.1f);
    double sharp_sum = 0, rough_sum = 0;
    for (std::size_t i = 0; i < std::size_t{3} * kGlossSide * kGlossSide; ++i)
        sharp_sum += sharp.data()[i], rough_sum += rough.data()[i];
    EXPECT_LT(rough.at(40, 30, 1), 0.9f * sharp.at(40, 30, 1));
    EXPECT_NEAR(rough_sum / sharp_sum, 1.0, 0.05);
}

TEST(Highlights, NoneAndNoNumbersChangeNothing) {
    ImageF3 plate = glossy(green);
    const SurfaceColours colours = surface_colours(plate, kGlossMatte, kWhite);
    plate.at(5, 5, 1) = NAN;
    ImageF3 texture(kGlossSide, kGlossSide, 0.25f);
    add_highlights(texture, find_highlights({0, 0}, plate, kGlossMatte, flat_light(1), colours, {},
                                            {0, 0, kGlossSide}));
    EXPECT_EQ(texture.at(40, 30, 1), 0.25f);
    add_highlights(texture, find_highlights({0, 0}, plate, kGlossMatte, flat_light(1), colours, {},
                                            {1, 0, kGlossSide}));
    EXPECT_EQ(texture.at(5, 5, 1), 0.25f);
}

}  // namespace
}  // namespace weft
