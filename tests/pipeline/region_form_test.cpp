// A position pass gives a region its form.
#include "engine/pipeline/region_form.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/region_scene.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

// A column whose axis is upright: it turns away to both sides of x = 80.
class Column : public MemoryShot {
  public:
    Column() : MemoryShot(make_wall(false, false)) {}
    bool constant = false;

    [[nodiscard]] Expected<ImageF3> positions(int /*region*/, int /*frame*/) const override {
        ImageF3 out(kShotSize, 1.0f);
        for (int y = 0; !constant && y < kShotSize.height; ++y) {
            for (int x = 0; x < kShotSize.width; ++x) {
                const float s = (static_cast<float>(x) + 0.5f - 80) / 80;
                float* p = out.pixel(x, y);
                p[0] = s, p[1] = static_cast<float>(y) / 80, p[2] = std::sqrt(1 - s * s);
            }
        }
        return out;
    }
};

RegionPlan formed() {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    region.has_positions = true;
    return region;
}

float step_x(const TextureMapping& mapping, float x) {
    return mapping.texel({x + 1, 56}).x - mapping.texel({x - 1, 56}).x;
}

TEST(RegionForm, IsInTheScenesMapping) {
    const Column shot;
    const MemoryAnalysisStore store;
    RegionPlan region = formed();
    auto scene = make_scene(shot, make_plan(region), store, 0, {}, {});
    ASSERT_TRUE(scene) << scene.error().text();
    // 50 px from the axis the surface is seen at a cosine of 0.78.
    EXPECT_NEAR(step_x(scene->mapping, 30) / step_x(scene->mapping, 80), 1 / 0.78f, 0.04f);
    region.form_amount = 0.5f;
    scene = make_scene(shot, make_plan(region), store, 0, {}, {});
    EXPECT_NEAR(step_x(scene->mapping, 30) / step_x(scene->mapping, 80), 1.13f, 0.03f);
    region.scale_keys = {{{1, {2}}}};
    EXPECT_EQ(mapping_on(region, *scene, 4)->form(), scene->mapping.form());
    region.form_amount = 0;
    EXPECT_EQ(region_form(shot, make_plan(region), store, 0).value(), nullptr);
}

TEST(RegionForm, APassWithoutFormIsAnError) {
    Column shot;
    shot.constant = true;
    const auto found = region_form(shot, make_plan(formed()), MemoryAnalysisStore(), 0);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(found.error().message, ::testing::HasSubstr("frame 1"));
    EXPECT_FALSE(region_form(make_wall(), make_plan(formed()), MemoryAnalysisStore(), 0))
        << "a source without the pass";
}

}  // namespace
}  // namespace weft
