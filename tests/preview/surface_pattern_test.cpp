// The patterns that show how a texture lies, and the places that a texture is put on.
#include "app/preview/surface_pattern.h"

#include <gtest/gtest.h>

#include "app/preview/coords_jacobian.h"
#include "app/preview/surface_places.h"

namespace weft {
namespace {

constexpr Size kFrame{480, 60};  // cells of 20 px at a scale of 1

// Texels that are so many times as far apart as pixels.
TextureCoords coords(float along_x, float along_y) {
    TextureCoords out{ImageF2(kFrame), {0, 0}};
    for (int y = 0; y < kFrame.height; ++y) {
        for (int x = 0; x < kFrame.width; ++x) {
            out.uv.pixel(x, y)[0] = along_x * (static_cast<float>(x) + 0.5f);
            out.uv.pixel(x, y)[1] = along_y * (static_cast<float>(y) + 0.5f);
        }
    }
    return out;
}

OverlayPicture covered() {
    OverlayPicture out;
    out.where = Matte(kFrame, 255);
    out.value = Matte(kFrame);
    return out;
}

TEST(SurfacePattern, TheCheckerAlternatesAndLeavesTheRestAlone) {
    OverlayPicture out = covered();
    out.where.at(10, 10) = 0;
    draw_checker(coords(1, 1), 1, out);
    EXPECT_EQ(out.value.at(5, 5), 255);
    EXPECT_EQ(out.value.at(10, 10), 0);
    EXPECT_EQ(out.value.at(30, 10), 0);
    EXPECT_EQ(out.value.at(30, 30), 255);
    EXPECT_EQ(out.value.at(10, 30), 0);
}

TEST(SurfacePattern, CirclesAreAsNarrowAsTheSurfaceIsForeshortened) {
    OverlayPicture out = covered();
    draw_circles(coords(1, 2), 1, out);  // half as high on the plate
    // The radius is 8.4 texels about the middle of a cell, here (30, 5).
    EXPECT_EQ(out.value.at(30, 5), 0);
    EXPECT_GT(out.value.at(38, 5), 200);
    EXPECT_GT(out.value.at(30, 9), 200);
    EXPECT_EQ(out.value.at(34, 5), 0);
}

TEST(SurfacePattern, AStepOfAPixelIsKnownAtTheBorderToo) {
    const TextureCoords stretched = coords(3, 2);
    const Jacobian j = jacobian(stretched.uv, kFrame.width - 1, kFrame.height - 1);
    EXPECT_FLOAT_EQ(j.along_u(), 3);
    EXPECT_FLOAT_EQ(j.along_v(), 2);
    EXPECT_FLOAT_EQ(j.area(), 6);
}

TEST(SurfacePlaces, FollowTheSurfaceAndThenThePlacement) {
    LatticeField ref_from_cur(kFrame, 16);
    for (int j = 0; j < ref_from_cur.nodes().height(); ++j)
        for (int i = 0; i < ref_from_cur.nodes().width(); ++i)
            ref_from_cur.set_node(i, j, {10, -4});
    const SurfacePlaces places(ref_from_cur, TextureMapping(Mat3{0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 1}));
    const Vec2 at = places.at({30, 24});
    EXPECT_NEAR(at.x, 20, 1e-4);
    EXPECT_NEAR(at.y, 10, 1e-4);
}

}  // namespace
}  // namespace weft
