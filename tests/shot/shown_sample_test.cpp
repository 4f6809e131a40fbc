// A sample that is shown itself: tiled, mirrored or stretched.
#include "app/shot/shown_sample.h"

#include <gtest/gtest.h>

#include "engine/color/color_space.h"

namespace weft {
namespace {

// Checks of 16 px that begin within a period: 100 px hold three periods of 32.
TexturePicture checks() {
    TexturePicture out;
    out.pixels = ImageF3(100, 100);
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 100; ++x) {
            const bool dark = (x / 16 + y / 16) % 2 == 0;
            for (int c = 0; c < 3; ++c)
                out.pixels.pixel(x, y)[c] = dark ? 0.2f : 0.7f;
        }
    }
    return out;
}

struct Shown {
    TexturePicture texture = checks();
    RegionPlan plan;
    explicit Shown(PlaneMode mode) {
        plan.mode = mode;
        const auto display = make_color_transform({"srgb"}, {"srgb"});
        show_sample({40, 20, 640, 360}, **display, texture, plan);
    }
};

TEST(ShownSample, TilesRepeatByWholePeriods) {
    const Shown tile(PlaneMode::kTile);
    EXPECT_EQ(tile.texture.wrap, WrapMode::kRepeat);
    EXPECT_EQ(tile.texture.pixels.size(), (Size{96, 96}));
    EXPECT_FALSE(tile.plan.placement.corners);
}

TEST(ShownSample, AMirrorKeepsAllOfIt) {
    const Shown mirror(PlaneMode::kMirror);
    EXPECT_EQ(mirror.texture.wrap, WrapMode::kMirror);
    EXPECT_EQ(mirror.texture.pixels.size(), (Size{100, 100}));
}

TEST(ShownSample, AStretchedOneCoversTheSurfacesBoxOrTheCornersThatAreSet) {
    const Shown stretch(PlaneMode::kStretch);
    EXPECT_EQ(stretch.texture.wrap, WrapMode::kClamp);
    ASSERT_TRUE(stretch.plan.placement.corners);
    EXPECT_EQ((*stretch.plan.placement.corners)[0], Vec2(40, 20));
    EXPECT_EQ((*stretch.plan.placement.corners)[2], Vec2(640, 360));
    EXPECT_EQ(stretch.plan.placement.picture_texels, (Size{100, 100}));

    TexturePicture texture = checks();
    RegionPlan plan;
    plan.mode = PlaneMode::kStretch;
    plan.placement.corners = {Vec2(1, 2), Vec2(50, 2), Vec2(50, 40), Vec2(1, 40)};
    show_sample({0, 0, 640, 360}, **make_color_transform({"srgb"}, {"srgb"}), texture, plan);
    EXPECT_EQ((*plan.placement.corners)[0], Vec2(1, 2));
}

}  // namespace
}  // namespace weft
