#include "engine/motion/color_picture.h"

#include <gtest/gtest.h>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kStripedFrame{120, 96};

// Stripes of two paints in `light` of one colour (linear), as sRGB codes.
template <class F>
ImageU8x3 striped(const F& light, const Vec3& a, const Vec3& b) {
    ImageU8x3 out(kStripedFrame);
    for (int y = 0; y < kStripedFrame.height; ++y) {
        for (int x = 0; x < kStripedFrame.width; ++x) {
            const Vec3 linear = (x / 12 % 2 == 0 ? a : b) * light(centre_of(x, y));
            for (int c = 0; c < 3; ++c) {
                out.pixel(x, y)[c] = code_of(1.055f * std::pow(linear[c], 1 / 2.4f) - 0.055f);
            }
        }
    }
    return out;
}

const Vec3 kRed(0.5f, 0.22f, 0.2f), kBlue(0.2f, 0.3f, 0.5f), kGrey(0.3f, 0.3f, 0.3f);
const Matte kAll(kStripedFrame, 255);

TEST(ColorPicture, ShowsPaintAndNotTheShade) {
    const auto even = [](Vec2) { return 1.0f; };
    // A shade across the stripes, half as bright.
    const auto shaded = [](Vec2 p) { return p.y < 40 ? 1.0f : 0.5f; };
    const auto axis = color_axis(striped(even, kRed, kBlue), kAll);
    ASSERT_TRUE(axis);
    EXPECT_NEAR(axis->direction.x + axis->direction.y + axis->direction.z, 0, 1e-4);
    const Matte bright = color_picture(striped(even, kRed, kBlue), *axis);
    const Matte dark = color_picture(striped(shaded, kRed, kBlue), *axis);
    const int paints = std::abs(bright.at(6, 70) - bright.at(18, 70));
    EXPECT_GT(paints, 100);
    for (int x = 0; x < kStripedFrame.width; ++x)
        EXPECT_NEAR(bright.at(x, 70), dark.at(x, 70), 0.12 * paints) << x;
}

TEST(ColorPicture, IsNoneForPaintsOfOneColour) {
    const auto shaded = [](Vec2 p) { return p.y < 40 ? 1.0f : 0.4f; };
    EXPECT_FALSE(color_axis(striped(shaded, kGrey, 0.5f * kGrey), kAll));
    EXPECT_FALSE(color_axis(striped(shaded, kRed, kBlue), Matte(kStripedFrame)));
}

}  // namespace
}  // namespace weft
