#include <gtest/gtest.h>

#include <cmath>

#include "engine/color/color_space.h"
#include "engine/lighting/plate_transfer.h"

namespace weft {
namespace {

constexpr int kNoiseSide = 64;

ImageF3 tinted_noise(float middle, float swing, unsigned key) {
    ImageF3 out(kNoiseSide, kNoiseSide);
    for (int y = 0; y < kNoiseSide; ++y) {
        for (int x = 0; x < kNoiseSide; ++x) {
            key = key * 1664525u + 1013904223u;
            const float v =
                middle + swing * (static_cast<float>(key >> 8 & 0xffffu) / 65535.0f - 0.5f);
            const float linear = srgb_to_linear(v);
            out.at(x, y, 0) = 1.1f * linear, out.at(x, y, 1) = linear,
                         out.at(x, y, 2) = 0.6f * linear;
        }
    }
    return out;
}

struct Moments {
    double mean, deviation;
};
Moments lumas(const ImageF3& p) {
    double n = 0, s = 0, ss = 0;
    for (int y = 0; y < kNoiseSide; ++y) {
        for (int x = 0; x < kNoiseSide; ++x) {
            const float* q = p.pixel(x, y);
            const double v = linear_to_srgb(0.2126f * q[0] + 0.7152f * q[1] + 0.0722f * q[2]);
            n += 1, s += v, ss += v * v;
        }
    }
    return {s / n, std::sqrt(ss / n - s * s / n / n)};
}

TEST(PlateTransfer, StatisticsAndHistogramGiveThePlatesMeanAndDeviation) {
    const ImageF3 plate = tinted_noise(0.4f, 0.2f, 3);
    const Matte all(plate.size(), 255);
    const Moments want = lumas(plate);
    for (const bool histogram : {false, true}) {
        ImageF3 texture = tinted_noise(0.7f, 0.4f, 9);
        if (histogram)
            match_histogram(texture, plate, all, 1);
        else
            transfer_statistics(texture, plate, all, 1);
        const Moments got = lumas(texture);
        EXPECT_NEAR(got.mean, want.mean, 0.01);
        EXPECT_NEAR(got.deviation, want.deviation, 0.01);
        EXPECT_NEAR(texture.at(5, 5, 0) / texture.at(5, 5, 2), 1.1f / 0.6f, 1e-3f);  // hue stays
    }
}

// Grey paint under light that is blue in the dark half.
TEST(PlateTransfer, TheColourOfLightIsTakenOver) {
    ImageF3 plate(kNoiseSide, kNoiseSide);
    Shading shading{ImageF1(kNoiseSide, kNoiseSide), 1, plate.size()};
    for (int y = 0; y < kNoiseSide; ++y) {
        for (int x = 0; x < kNoiseSide; ++x) {
            const bool dark = x < kNoiseSide / 2;
            plate.at(x, y, 0) = dark ? 0.10f : 0.4f;
            plate.at(x, y, 1) = dark ? 0.12f : 0.4f;
            plate.at(x, y, 2) = dark ? 0.20f : 0.4f;
            const float* p = plate.pixel(x, y);
            shading.value.at(x, y) = 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
        }
    }
    const Matte all(plate.size(), 255);
    const LightColour colour = light_colour(plate, all, shading);
    ASSERT_TRUE(colour.known);
    ImageF3 texture(kNoiseSide, kNoiseSide, 0.5f);
    apply_cast(texture, {0, 0}, all, shading, 0.4f, colour, colour, 1);
    EXPECT_GT(texture.at(5, 5, 2), 1.3f * texture.at(5, 5, 0));
    EXPECT_NEAR(texture.at(60, 5, 2), 0.5f, 0.02f);
    const float* p = texture.pixel(5, 5);
    EXPECT_NEAR(0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2], 0.5f, 1e-3f);
}

TEST(PlateTransfer, AnArtistsPassIsTheExactShading) {
    ImageF3 plate(8, 8, 0.06f), albedo(8, 8, 0.2f);
    albedo.at(3, 3, 0) = albedo.at(3, 3, 1) = albedo.at(3, 3, 2) = 0;  // says nothing
    const Shading s = shading_from_albedo(plate, albedo);
    EXPECT_EQ(s.downscale, 1);
    EXPECT_NEAR(s.value.at(5, 5), 0.3f, 1e-5f);
    EXPECT_NEAR(s.value.at(3, 3), 0.3f, 1e-4f);
    EXPECT_NEAR(shading_from_lighting(plate, plate).value.at(0, 0), 0.06f, 1e-6f);
}

TEST(PlateTransfer, APassIsBlackWhereNoLightFalls) {
    ImageF3 lighting(8, 8, 0.3f), plate(8, 8, 0.06f);
    const auto blacken = [](ImageF3& picture, int x, int y) {
        std::fill_n(picture.pixel(x, y), 3, 0.0f);
    };
    blacken(lighting, 2, 2);  // a cast shadow
    blacken(plate, 2, 2);
    blacken(lighting, 6, 6);  // not covered by the pass: the plate is lit
    const Shading s = shading_from_lighting(lighting, plate);
    EXPECT_LT(s.value.at(2, 2), 1e-3f);
    EXPECT_NEAR(s.value.at(6, 6), 0.3f, 1e-4f);
    Shading most_in_shadow{ImageF1(8, 8, 1e-5f), 1, {8, 8}};
    std::fill_n(most_in_shadow.value.row(3), 8, 0.4f);
    EXPECT_EQ(median_shading(most_in_shadow, Matte(8, 8, 255)), 0.4f) << "of what is lit";
    const ImageF3 albedo(8, 8, 0.2f);
    EXPECT_LT(shading_from_albedo(plate, albedo).value.at(2, 2), 1e-3f);
}

}  // namespace
}  // namespace weft
