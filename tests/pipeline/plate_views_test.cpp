#include "engine/pipeline/plate_views.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/pipeline/paper_walker.h"
#include "engine/pipeline/region_scene.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

TEST(PlateViews, AreCodesLumaAndWhereThePlateIsFinite) {
    ImageF3 plate(3, 2, 0.5f);
    plate.at(1, 0, 0) = std::numeric_limits<float>::quiet_NaN();
    plate.at(2, 0, 1) = std::numeric_limits<float>::infinity();
    plate.at(0, 1, 2) = -3;
    for (int c = 0; c < 3; ++c)
        plate.at(1, 1, c) = 7;
    const PlateViews views = make_views(plate, *color("srgb", "srgb"));
    EXPECT_EQ(views.display.at(0, 0, 0), 128);
    EXPECT_EQ(views.luma.at(0, 0), 128);
    EXPECT_EQ(views.display.at(1, 0, 0), 0);
    EXPECT_EQ(views.display.at(2, 0, 1), 255);
    EXPECT_EQ(views.display.at(0, 1, 2), 0);
    EXPECT_EQ(views.luma.at(1, 1), 255);
    ASSERT_EQ(views.finite.size(), plate.size());
    EXPECT_EQ(views.finite.at(1, 0), 0);
    EXPECT_EQ(views.finite.at(2, 0), 0);
    EXPECT_EQ(views.finite.at(0, 1), 255);
    EXPECT_TRUE(make_views(ImageF3(3, 2, 0.5f), *color("srgb", "srgb")).finite.empty());
}

TEST(PlateViews, ShowLinearPlatesAsTheDisplayDoes) {
    const PlateViews views = make_views(ImageF3(2, 2, 0.2158605f), *color("linear", "srgb"));
    EXPECT_EQ(views.display.at(1, 1, 2), 128);  // sRGB of 0.2159 is 0.502
}

TEST(Mattes, LoseWhatTheHoldoutCovers) {
    Matte extent(4, 1, 200), holdout(4, 1);
    holdout.at(1, 0) = 255;
    holdout.at(2, 0) = 128;
    holdout.at(3, 0) = 1;
    const Matte out = without_holdout(extent, holdout);
    EXPECT_EQ(out.at(0, 0), 200);
    EXPECT_EQ(out.at(1, 0), 0);
    EXPECT_EQ(out.at(2, 0), 100);  // 200 · 127 / 255 = 99.6
    EXPECT_EQ(out.at(3, 0), 199);
    EXPECT_EQ(without_holdout(extent, {}), extent);
}

TEST(Mattes, BoundsHoldEveryPixelAboveNothing) {
    Matte matte(20, 10);
    EXPECT_TRUE(matte_bounds(matte).empty());
    matte.at(7, 3) = 1;
    matte.at(12, 8) = 255;
    EXPECT_EQ(matte_bounds(matte), (Recti{7, 3, 13, 9}));
}

TEST(FramePlane, CoversTheFrame) {
    PlanePlacement placement;
    placement.scale = 2;
    placement.rotate_deg = 30;
    placement.offset_px = {50, 20};
    const auto plane = frame_plane(placement, {160, 112});
    ASSERT_TRUE(plane);
    const TextureMapping map = *texture_mapping(placement);
    for (const Vec2 corner : {Vec2(0, 0), Vec2(160, 0), Vec2(0, 112), Vec2(160, 112)}) {
        const Vec2 u = map.texel(corner) - Vec2(plane->origin);
        EXPECT_GE(u.x, 0);
        EXPECT_GE(u.y, 0);
        EXPECT_LE(u.x, static_cast<float>(plane->size.width));
        EXPECT_LE(u.y, static_cast<float>(plane->size.height));
    }
    EXPECT_LT(plane->size.width, 110);
}

TEST(FramePlane, RefusesMoreTexelsThanFit) {
    PlanePlacement placement;
    placement.scale = 0.01f;
    const auto plane = frame_plane(placement, {160, 112});
    ASSERT_FALSE(plane);
    EXPECT_EQ(plane.error().code, ErrorCode::kUsage);
    EXPECT_NE(plane.error().text().find("scale"), std::string::npos);
}

TEST(PlaneSize, GrowsAsTheScaleFallsWithinLimits) {
    const auto width = [](float scale) {
        PlanePlacement placement;
        placement.scale = scale;
        return plane_size(placement, {1000, 500}).width;
    };
    EXPECT_EQ(width(1), 1280);
    EXPECT_EQ(width(0.01f), 4096);
    EXPECT_EQ(width(100), 512);
}

}  // namespace
}  // namespace weft
