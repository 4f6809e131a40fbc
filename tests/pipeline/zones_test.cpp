// Zones: where a setting has another value, painted or from files, and what they do to the light.
#include <gtest/gtest.h>

#include "engine/compute/backend_registry.h"
#include "engine/pipeline/matte_pass.h"
#include "engine/pipeline/region_zones.h"
#include "engine/pipeline/render_frame.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

// The wall with a box on every frame as the matte of each of its zones.
class LightZonedWall : public MemoryShot {
  public:
    LightZonedWall() : MemoryShot(make_wall(false, false)) {}
    [[nodiscard]] Expected<Matte> zone(int, int, int) const override { return box_matte(kZoneBox); }
    [[nodiscard]] Expected<Matte> zone_key(int, int zone, int frame) const override {
        EXPECT_EQ(zone, 1);
        EXPECT_EQ(frame, 4);
        return box_matte(kZoneBox);
    }
};

ZonePlan light_zone(float value) {
    ZonePlan zone;
    zone.value = value;
    return zone;
}

TEST(Zones, LayersOfZonesAreApartFromThoseOfMattes) {
    for (const int zone : {0, 1, 7}) {
        EXPECT_TRUE(is_zone_layer(zone_layer(zone)));
        EXPECT_EQ(zone_of_layer(zone_layer(zone)), zone);
    }
    EXPECT_FALSE(is_zone_layer(0));
    EXPECT_FALSE(is_zone_layer(1));
}

TEST(Zones, FactorsMultiplyInsideAndAreOneOutside) {
    const LightZonedWall shot;
    RegionPlan region = make_region(flat_texture({1, 1, 1}));
    region.zones = {light_zone(0.5f), light_zone(1.0f)};
    region.zones[1].value_keys = {{{1, {2}}, {5, {0}}}};
    const ShotPlan plan = make_plan(region);
    const MemoryAnalysisStore store;
    for (const auto& [frame, expected] : {std::pair{1, 1.0f}, {3, 0.5f}, {5, 0.0f}}) {
        const auto factor = zone_factor(shot, plan, store, 0, ZoneKind::kLight, frame);
        ASSERT_TRUE(factor) << factor.error().text();
        EXPECT_NEAR(factor->at(60, 50), expected, 1e-5f) << frame;
        EXPECT_EQ(factor->at(20, 20), 1.0f);
    }
    const ShotPlan none = make_plan(make_region(flat_texture({1, 1, 1})));
    EXPECT_TRUE(zone_factor(shot, none, store, 0, ZoneKind::kLight, 1)->empty());
}

TEST(Zones, LightIsScaledAboutItsReference) {
    Shading shading{ImageF1(4, 3, 0.5f), 2, {7, 6}};
    shading.value.at(3, 2) = 4.0f;
    ImageF1 factor(7, 6, 1.0f);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x)
            factor.at(x, y) = 0;
    factor.at(2, 0) = factor.at(2, 1) = 0;  // half of the second block
    factor.at(6, 4) = factor.at(6, 5) = 2;  // the last block is half as wide
    scale_light(shading, 1.0f, factor);
    EXPECT_NEAR(shading.value.at(0, 0), 1.0f, 1e-6f) << "no light: as on the reference frame";
    EXPECT_NEAR(shading.value.at(1, 0), 0.75f, 1e-6f);
    EXPECT_NEAR(shading.value.at(2, 0), 0.5f, 1e-6f);
    EXPECT_NEAR(shading.value.at(3, 2), 7.0f, 1e-5f);
    Shading deep{ImageF1(1, 1, 0.1f), 2, {2, 2}};
    scale_light(deep, 1.0f, ImageF1(2, 2, 2.0f));
    EXPECT_GT(deep.value.at(0, 0), 0.0f) << "1 + 2 · (0.1 − 1) would be below";
}

TEST(Zones, OnlyInsideOneTheTextureTakesNoLight) {
    const LightZonedWall shot;
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    region.light_source = LightSource::kPainted;
    region.lamps = {{LampKind::kPoint, {{{0, {80, 56, 200, 3}}}}}};
    region.zones = {light_zone(0), light_zone(1)};
    region.zones[1].painted.keys = {4};
    const ShotPlan plan = make_plan(region, 3, 6);
    MemoryAnalysisStore store;
    EXPECT_GT(count_matte_steps(plan, store), 0);
    expect_ok(analyse_shot(shot, plan, store, {}, {}));
    for (const int frame : plan.frames) {
        EXPECT_TRUE(store.has({0, frame, AnalysisKind::kMatte, zone_layer(1)})) << frame;
        EXPECT_FALSE(store.has({0, frame, AnalysisKind::kMatte, zone_layer(0)})) << frame;
    }
    const auto render = [&](const ShotPlan& what) {
        auto scene = make_scene(shot, what, store, 0, {}, {});
        EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
        const std::vector<RegionScene> scenes{std::move(*scene)};
        auto frame = render_frame(shot, what, scenes, store, *make_cpu_backend(), 5);
        EXPECT_TRUE(frame) << (frame ? "" : frame.error().text());
        return std::move(frame->pixels);
    };
    ShotPlan unlit = plan, unzoned = plan;
    unlit.regions[0].light_source = LightSource::kNone;
    unzoned.regions[0].zones.clear();
    const ImageF3 zoned = render(plan), dark = render(unlit), lit = render(unzoned);
    EXPECT_GT(lit.pixel(60, 50)[1], dark.pixel(60, 50)[1] + 0.05f);
    EXPECT_NEAR(zoned.pixel(60, 50)[1], dark.pixel(60, 50)[1], 2e-3f);
    EXPECT_EQ(zoned.pixel(110, 80)[1], lit.pixel(110, 80)[1]);
}

}  // namespace
}  // namespace weft
