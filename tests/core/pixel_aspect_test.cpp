#include "engine/core/pixel_aspect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/core/unsqueezed_image.h"

namespace weft {
namespace {

TEST(PixelAspect, UnsqueezesPlacesAndSizes) {
    const PixelAspect wide(2);
    EXPECT_EQ(wide.unsqueezed(Vec2(10, 7)), Vec2(20, 7));
    EXPECT_EQ(wide.squeezed(wide.unsqueezed(Vec2(10, 7))), Vec2(10, 7));
    EXPECT_EQ(wide.unsqueezed(Size{100, 50}), (Size{200, 50}));
    EXPECT_EQ(PixelAspect(16.0 / 15).unsqueezed(Size{720, 576}), (Size{768, 576}));
    EXPECT_TRUE(PixelAspect().square());
    EXPECT_EQ(PixelAspect().unsqueezed(Vec2(0.1f, -3)), Vec2(0.1f, -3));
    EXPECT_FALSE(wide.square());
}

// A straight slope stays one, at half of it; the middle of a pixel is where it was.
TEST(UnsqueezedImage, KeepsWhereThingsLie) {
    ImageF1 slope(40, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 40; ++x)
            slope.at(x, y) = static_cast<float>(x) + 0.5f;
    for (const double ratio : {2.0, 1.25, 0.5}) {
        const PixelAspect aspect(ratio);
        const ImageF1 out = unsqueezed(slope, aspect);
        ASSERT_EQ(out.size(), aspect.unsqueezed(slope.size()));
        for (int x = out.width() / 4; x < out.width() * 3 / 4; ++x)
            EXPECT_NEAR(out.at(x, 1), (static_cast<float>(x) + 0.5f) / aspect.ratio(), 1e-4f);
        const ImageF1 back = squeezed(out, aspect, slope.size());
        ASSERT_EQ(back.size(), slope.size());
        for (int x = 8; x < 32; ++x)
            EXPECT_NEAR(back.at(x, 0), slope.at(x, 0), 1e-4f) << ratio;
    }
    EXPECT_EQ(unsqueezed(slope, PixelAspect()), slope);
}

TEST(UnsqueezedImage, MattesStayWholeInsideAndTheUnknownStaysUnknown) {
    Matte matte(8, 1);
    for (int x = 3; x < 6; ++x)
        matte.at(x, 0) = 255;
    const Matte wide = unsqueezed(matte, PixelAspect(2));
    EXPECT_EQ(wide.at(6, 0), 191) << "a quarter pixel from the edge";
    for (int x = 7; x < 11; ++x)
        EXPECT_EQ(wide.at(x, 0), 255);
    EXPECT_EQ(wide.at(13, 0), 0);
    ImageF1 places(8, 1, 1.0f);
    places.at(2, 0) = std::numeric_limits<float>::quiet_NaN();
    const ImageF1 shown = unsqueezed(places, PixelAspect(2));
    EXPECT_TRUE(std::isnan(shown.at(4, 0)));
    EXPECT_EQ(shown.at(8, 0), 1);
}

// A photograph of 2835 by 2834 dots a metre.
TEST(PixelAspect, RoundedSquaresAreSquare) {
    EXPECT_TRUE(PixelAspect(2834.0 / 2835).square());
    EXPECT_FALSE(PixelAspect(16.0 / 15).square());
}

}  // namespace
}  // namespace weft
