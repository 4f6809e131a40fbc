#include "engine/metrics/ideal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/metrics/region.h"
#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

using synthetic::constant_motion;

constexpr Size kIdealSize{40, 32};

ImageU8x3 plane_of_waves(int side, double period) {
    ImageU8x3 p(side, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double v = 128 + 100 * std::sin(2 * synthetic::kPi * (x + 0.5) / period);
            for (int c = 0; c < 3; ++c)
                p.at(x, y, c) = static_cast<std::uint8_t>(std::lround(v));
        }
    }
    return p;
}

ImageU8x3 checkerboard(int side) {
    ImageU8x3 p(side, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            for (int c = 0; c < 3; ++c)
                p.at(x, y, c) = (x + y) % 2 == 0 ? 255 : 0;
        }
    }
    return p;
}

TEST(Ideal, IsTheMeanOverThePixelsArea) {
    const IdealTexture texture(plane_of_waves(32, 8));
    // The mean over one pixel keeps sinc(1/8) of a wave of 8 texels; shift by a fraction and wrap.
    const double gain = std::sin(synthetic::kPi / 8) / (synthetic::kPi / 8);
    const ImageF1 y = texture.render_luma(constant_motion(kIdealSize, -13.3f, 70.7f), {});
    for (int x = 0; x < kIdealSize.width; ++x) {
        const double phase = 2 * synthetic::kPi * (x + 0.5 - 13.3) / 8;
        EXPECT_NEAR(y.at(x, 9), 128 + 100 * gain * std::sin(phase), 1.5) << x;
    }
}

TEST(Ideal, FollowsPlacementAndMotion) {
    const IdealTexture texture(plane_of_waves(64, 16));
    Mat3 turned(0);  // u = y, v = −x: the waves run down the plate.
    turned[0][1] = -1;
    turned[1][0] = 1;
    turned[2][2] = 1;
    const ImageF1 y = texture.render_luma(FlowField(kIdealSize), TextureMapping(turned));
    EXPECT_NEAR(y.at(3, 11), y.at(30, 11), 0.01);
    EXPECT_NEAR(y.at(3, 4), 128 + 100 * std::sin(2 * synthetic::kPi * 4.5 / 16), 2);
    // A field that doubles the picture's scale about the origin halves the texture's frequency.
    FlowField doubled(kIdealSize);
    for (int j = 0; j < kIdealSize.height; ++j) {
        for (int i = 0; i < kIdealSize.width; ++i) {
            doubled.d.at(i, j, 0) = -0.5f * (static_cast<float>(i) + 0.5f);
            doubled.d.at(i, j, 1) = -0.5f * (static_cast<float>(j) + 0.5f);
        }
    }
    const ImageF1 z = texture.render_luma(doubled, {});
    EXPECT_NEAR(z.at(20, 5), 128 + 100 * std::sin(2 * synthetic::kPi * 20.5 / 32), 2);
}

TEST(Ideal, DoesNotAliasWhenMinifiedAndAveragesInTheLightThatIsAskedFor) {
    Mat3 small(1);
    small[0][0] = small[1][1] = 11.0f;
    small[2][0] = 0.37f;
    const ImageF3 encoded =
        IdealTexture(checkerboard(32)).render(FlowField(kIdealSize), TextureMapping(small));
    IdealFilter filter;
    filter.linear_light = true;
    const ImageF3 linear =
        IdealTexture(checkerboard(32), filter).render(FlowField(kIdealSize), TextureMapping(small));
    for (int x = 0; x < kIdealSize.width; ++x) {
        EXPECT_NEAR(encoded.at(x, 7, 1), 0.5, 0.03);
        EXPECT_NEAR(linear.at(x, 7, 1), 0.7354, 0.03);  // sRGB code of linear 0.5.
    }
}

TEST(Ideal, IsNothingWhereTheFieldIsNotValidAndItsLumaAgrees) {
    const IdealTexture texture(synthetic::blobs(48, 3));
    FlowField f = constant_motion(kIdealSize, 1.4f, 0.3f);
    f.valid.at(5, 6) = 0;
    const ImageF3 rgb = texture.render(f, {});
    const ImageF1 luma = texture.render_luma(f, {});
    const ImageF1 of_rgb = luma_8bit(rgb);
    EXPECT_EQ(luma.at(5, 6), 0);
    for (int y = 0; y < kIdealSize.height; ++y) {
        for (int x = 0; x < kIdealSize.width; ++x)
            EXPECT_NEAR(luma.at(x, y), of_rgb.at(x, y), 0.01);
    }
}

}  // namespace
}  // namespace weft
