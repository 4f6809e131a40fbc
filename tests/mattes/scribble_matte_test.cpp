// Mattes from scribbles: a surface of one colour on a ground of another.
#include "app/mattes/scribble_matte.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/mattes/filled.h"

namespace weft {
namespace {

constexpr Size kPlate{400, 300};
constexpr Recti kSurface{60, 20, 340, 280};

// Both grained, so that colours have a spread.
ImageU8x3 plate(const Recti& surface = kSurface) {
    ImageU8x3 out(kPlate, 0);
    for (int y = 0; y < kPlate.height; ++y)
        for (int x = 0; x < kPlate.width; ++x) {
            const bool inside = surface.contains(x, y);
            const auto grain = static_cast<std::uint8_t>((x * 7 + y * 13) % 11);
            std::uint8_t* p = out.pixel(x, y);
            p[0] = static_cast<std::uint8_t>((inside ? 180 : 40) + grain);
            p[1] = static_cast<std::uint8_t>((inside ? 60 : 90) + grain);
            p[2] = static_cast<std::uint8_t>((inside ? 40 : 160) + grain);
        }
    return out;
}

Matte filled(const Recti& area) {
    return test::filled(area, kPlate);
}

// Share of pixels that differ by more than half, in per cent.
double percent_wrong(const Matte& found, const Matte& wanted) {
    int wrong = 0;
    for (int y = 0; y < kPlate.height; ++y)
        for (int x = 0; x < kPlate.width; ++x)
            wrong += std::abs(found.at(x, y) - wanted.at(x, y)) > 127 ? 1 : 0;
    return 100.0 * wrong / (kPlate.width * kPlate.height);
}

TEST(ScribbleMatte, FindsASurfaceThatReachesFarBeyondItsLines) {
    const Matte keep = filled({190, 140, 210, 146}), drop = filled({20, 140, 26, 160});
    const Matte found = segment_scribbles(Matte(kPlate), plate(), keep, drop);
    EXPECT_LT(percent_wrong(found, filled(kSurface)), 1);
}

TEST(ScribbleMatte, GoesOnIntoWhatWasPaintedWithoutAStep) {
    // Painted roughly; the line is small, so that the crop ends within the surface.
    const Matte before = filled({80, 40, 320, 260}), keep = filled({196, 140, 204, 146});
    const Matte found = segment_scribbles(before, plate(), keep, Matte(kPlate));
    for (int x = 80; x < 320; ++x)
        EXPECT_GT(found.at(x, 143), 127) << x;
    EXPECT_LT(percent_wrong(found, before), 1);
}

TEST(ScribbleMatte, LinesOutsideTakeAway) {
    const Matte keep = filled({190, 140, 210, 146}), drop = filled({20, 20, 26, 280});
    const Matte found = segment_scribbles(filled({10, 10, 390, 290}), plate(), keep, drop);
    EXPECT_LT(found.at(40, 150), 128);
    EXPECT_GT(found.at(80, 150), 127);
}

// A shirt that fills the picture's top: no strip of it is left.
TEST(ScribbleMatte, GoesOnToThePicturesBorder) {
    constexpr Recti kCut{150, 0, 220, 240};
    const Matte keep = filled({180, 100, 200, 106});
    const Matte found = segment_scribbles(Matte(kPlate), plate(kCut), keep, Matte(kPlate));
    for (int k = 160; k < 215; ++k) {
        EXPECT_GT(found.at(k, 0), 127) << k;
        EXPECT_LT(found.at(k, kPlate.height - 1), 128) << k;
    }
    EXPECT_LT(percent_wrong(found, filled(kCut)), 1);
}

// A table that ends at three of the picture's borders: no corner is cut off.
TEST(ScribbleMatte, GoesOnIntoThePicturesCorners) {
    constexpr Recti kTable{0, 120, 400, 300};
    const Matte keep = filled({110, 220, 290, 226});
    const Matte found = segment_scribbles(Matte(kPlate), plate(kTable), keep, Matte(kPlate));
    for (const Vec2i corner : {Vec2i{2, 297}, Vec2i{397, 297}, Vec2i{0, 299}, Vec2i{2, 130}})
        EXPECT_GT(found.at(corner.x, corner.y), 127) << corner.x << ' ' << corner.y;
    EXPECT_LT(percent_wrong(found, filled(kTable)), 1);
}

// A curtain that gets darker from left to right has no edge at which a surface could end.
TEST(ScribbleMatte, AShortLineStaysNearWhereNoEdgeEndsTheSurface) {
    ImageU8x3 curtain(kPlate, 0);
    for (int y = 0; y < kPlate.height; ++y)
        for (int x = 0; x < kPlate.width; ++x)
            for (int k = 0; k < 3; ++k)
                curtain.pixel(x, y)[k] =
                    static_cast<std::uint8_t>(240 - x / 4 + (x * 7 + y * 13) % 5);
    const Matte keep = filled({60, 130, 66, 165});
    const Matte found = segment_scribbles(Matte(kPlate), curtain, keep, Matte(kPlate));
    EXPECT_GT(found.at(63, 150), 200);
    for (int y = 0; y < kPlate.height; ++y)
        for (int x = 110; x < kPlate.width; ++x)
            ASSERT_EQ(found.at(x, y), 0) << x << ' ' << y;
}

// As on the frames to which it is propagated: antialiased where the plate is.
TEST(ScribbleMatte, ItsEdgeIsAsSoftAsThePlates) {
    ImageU8x3 blended = plate();
    constexpr int kEdge = 60;
    for (int y = kSurface.y0; y < kSurface.y1; ++y)
        for (int k = 0; k < 3; ++k)
            blended.pixel(kEdge, y)[k] = static_cast<std::uint8_t>(
                (blended.pixel(kEdge - 1, y)[k] + blended.pixel(kEdge + 1, y)[k]) / 2);
    const Matte keep = filled({190, 140, 210, 146}), drop = filled({20, 140, 26, 160});
    const Matte found = segment_scribbles(Matte(kPlate), blended, keep, drop);
    int partly = 0;
    for (int y = 60; y < 240; ++y)
        partly += found.at(kEdge, y) > 80 && found.at(kEdge, y) < 175;
    EXPECT_GT(partly, 150) << "of 180 pixels that are half covered";
    EXPECT_EQ(found.at(kEdge - 4, 150), 0);
    EXPECT_EQ(found.at(kEdge + 4, 150), 255);
}

TEST(ScribbleMatte, WithoutALineInsideNothingChanges) {
    const Matte before = filled({80, 40, 320, 260});
    EXPECT_EQ(segment_scribbles(before, plate(), Matte(kPlate), filled({20, 20, 26, 60})), before);
}

}  // namespace
}  // namespace weft
