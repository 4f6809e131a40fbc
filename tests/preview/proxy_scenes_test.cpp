#include <gtest/gtest.h>

#include "app/preview/proxy_shot.h"

namespace weft {
namespace {

TEST(ProxyScenes, SharePlanesAndLeaveTheirScenesAsTheyAre) {
    std::vector<RegionScene> scenes(1);
    RegionScene& scene = scenes.front();
    scene.plane = PlanePyramid(ImageF3(8, 8, 0.5f), WrapMode::kRepeat);
    scene.mapping = TextureMapping(Mat3(2, 0, 0, 0, 2, 0, 5, 6, 1));
    scene.picture_light = Shading{ImageF1(40, 30, 1.0f), 2, {80, 60}};
    scene.seams.emplace_back();

    const std::vector<RegionScene> small = proxy_scenes(scenes, 4);
    ASSERT_EQ(small.size(), 1u);
    EXPECT_EQ(small[0].plane.identity(), scene.plane.identity());
    EXPECT_EQ(small[0].plane.levels().data(), scene.plane.levels().data());
    // What a pixel of the proxy shows is what lay under it at full size.
    EXPECT_EQ(small[0].mapping.texel({10, 5}), scene.mapping.texel({40, 20}));
    EXPECT_EQ(small[0].picture_light->full, (Size{20, 15}));
    EXPECT_TRUE(small[0].seams.empty());

    EXPECT_EQ(scene.mapping, TextureMapping(Mat3(2, 0, 0, 0, 2, 0, 5, 6, 1)));
    EXPECT_EQ(scene.picture_light->full, (Size{80, 60}));
    EXPECT_EQ(scene.seams.size(), 1u);
}

}  // namespace
}  // namespace weft
