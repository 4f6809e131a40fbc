// Outlines of mattes at half coverage.
#include "engine/mask/matte_outlines.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

// A disc whose edge is a pixel wide.
Matte soft_disc(Size size, Vec2 centre, float radius) {
    Matte out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const float dx = static_cast<float>(x) + 0.5f - centre.x;
            const float dy = static_cast<float>(y) + 0.5f - centre.y;
            const float inside = radius - std::sqrt(dx * dx + dy * dy) + 0.5f;
            out.at(x, y) = static_cast<std::uint8_t>(255 * std::clamp(inside, 0.0f, 1.0f) + 0.5f);
        }
    return out;
}

TEST(MatteOutlines, ADiscsEdgeIsFoundBetweenPixels) {
    const Vec2 centre(40.3f, 31.6f);
    const auto outlines = outlines_of_matte(soft_disc({80, 64}, centre, 20.25f), 10);
    ASSERT_EQ(outlines.size(), 1u);
    EXPECT_EQ(outlines[0].level, 0);
    EXPECT_NEAR(outlines[0].area_px, 3.14159 * 20.25 * 20.25, 5);
    for (const Vec2 p : outlines[0].path.points())
        EXPECT_NEAR(std::hypot(p.x - centre.x, p.y - centre.y), 20.25f, 0.1f);
}

TEST(MatteOutlines, NestedOnesAlternate) {
    Matte matte(Size{60, 60});
    const auto fill = [&](int from, int to, std::uint8_t value) {
        for (int y = from; y < to; ++y)
            for (int x = from; x < to; ++x)
                matte.at(x, y) = value;
    };
    fill(5, 55, 255), fill(15, 45, 0), fill(25, 35, 255);
    const auto outlines = outlines_of_matte(matte, 10);
    ASSERT_EQ(outlines.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(outlines[k].level, static_cast<int>(k));
    EXPECT_EQ(outlines_of_matte(matte, 500).size(), 2u) << "the island is too small";
}

TEST(MatteOutlines, TheBordersOfThePictureLieInside) {
    const Matte full(Size{30, 20}, 255);
    const auto outlines = outlines_of_matte(full, 10);
    ASSERT_EQ(outlines.size(), 1u);
    EXPECT_NEAR(outlines[0].area_px, 32 * 22, 2);
}

// Two squares that touch at a corner: never lines that cross.
TEST(MatteOutlines, SaddlesAreTakenApartOrJoined) {
    Matte matte(Size{20, 20});
    for (int k = 0; k < 25; ++k)
        matte.at(5 + k % 5, 5 + k / 5) = matte.at(10 + k % 5, 10 + k / 5) = 255;
    double area = 0;
    for (const MatteOutline& outline : outlines_of_matte(matte, 1)) {
        EXPECT_EQ(outline.level, 0);
        area += outline.area_px;
    }
    EXPECT_NEAR(area, 50, 1.5);
    EXPECT_TRUE(outlines_of_matte(Matte(Size{20, 20}), 0).empty());
    EXPECT_TRUE(outlines_of_matte(Matte(), 0).empty());
}

TEST(OutlinePath, PlacesGoRound) {
    const OutlinePath square({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
    EXPECT_EQ(square.length(), 40);
    EXPECT_EQ(square.at(5), Vec2(5, 0));
    EXPECT_EQ(square.at(-5), Vec2(0, 5));
    EXPECT_EQ(square.at(85), Vec2(5, 0));
    EXPECT_EQ(square.direction(10, 1, 2), Vec2(0, 1));
    EXPECT_EQ(square.direction(10, -1, 2), Vec2(1, 0));
    EXPECT_NEAR(square.nearest({4, 3}).place, 4, 1e-5);
    // Not the top, which goes the other way.
    EXPECT_NEAR(square.nearest({4, 3}, {-1, 0}).place, 37, 1e-5);
}

}  // namespace
}  // namespace weft
