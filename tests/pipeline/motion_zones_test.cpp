// Motion zones: what rendering sees of the surface inside of them, and that nothing changes
// outside.
#include "engine/pipeline/motion_zones.h"

#include <gtest/gtest.h>

#include "engine/compute/backend_registry.h"
#include "engine/core/rng.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/render_frame.h"
#include "engine/pipeline/zone_kind.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

constexpr Recti kMotionZoneBox{64, 44, 96, 70};
constexpr int kZonedFrame = 6;
const AnalysisKey kPlace{0, kZonedFrame, AnalysisKind::kCoords};

class ZonedWall : public MemoryShot {
  public:
    explicit ZonedWall(Recti box = kMotionZoneBox) : MemoryShot(make_wall()), box_(box) {}
    [[nodiscard]] Expected<Matte> zone(int, int, int) const override { return box_matte(box_); }

  private:
    Recti box_;
};

RegionPlan zoned(ZoneKind kind, float value = 1) {
    RegionPlan region = make_region(sample_texture());
    ZonePlan zone;
    zone.kind = kind;
    zone.value = value;
    region.zones = {zone};
    return region;
}

LatticeField place_in(const AnalysisStore& store) {
    return stored_coords(store, kZonedFrame);
}

// Something that the walk might have made of a reflection.
LatticeField disturbed(LatticeField field) {
    Rng rng(5);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 p = field.node_position(i, j);
            if (p.x > 64 && p.x < 96 && p.y > 44 && p.y < 70)
                field.set_node(i, j, field.node(i, j) + Vec2(8 * rng.uniform(), 6 * rng.uniform()));
        }
    }
    return field;
}

RenderedFrame rendered_zones(const ShotSource& shot, const ShotPlan& plan,
                             const AnalysisStore& store) {
    auto scene = make_scene(shot, plan, store, 0, {}, {});
    EXPECT_TRUE(scene) << scene.error().text();
    const std::vector<RegionScene> scenes{std::move(*scene)};
    auto frame = render_frame(shot, plan, scenes, store, *make_cpu_backend(), kZonedFrame);
    EXPECT_TRUE(frame) << frame.error().text();
    return std::move(*frame);
}

TEST(MotionZones, MendInsideAndChangeNoPixelOutside) {
    const ZonedWall shot;
    const ShotPlan plain = make_plan(make_region(sample_texture()));
    MemoryAnalysisStore store;
    analyse(shot, plain, store);
    const LatticeField true_place = place_in(store);
    ASSERT_TRUE(store.put(kPlace, encode(disturbed(true_place))));
    const RenderedFrame before = rendered_zones(shot, plain, store);

    const ShotPlan plan = make_plan(zoned(ZoneKind::kIgnore));
    const ZonedAnalysis seen(shot, plan, store);
    EXPECT_GT(distance(place_in(store).at({80, 57}), true_place.at({80, 57})), 1.0f);
    EXPECT_LT(distance(place_in(seen).at({80, 57}), true_place.at({80, 57})), 0.2f);

    const RenderedFrame after = rendered_zones(shot, plan, store);
    int changed = 0;
    for (int y = 0; y < kShotSize.height; ++y) {
        for (int x = 0; x < kShotSize.width; ++x) {
            const bool same = std::equal(before.pixels.pixel(x, y), before.pixels.pixel(x, y) + 3,
                                         after.pixels.pixel(x, y));
            changed += same ? 0 : 1;
            ASSERT_TRUE(same || kMotionZoneBox.grown(24).contains(x, y)) << x << "," << y;
        }
    }
    EXPECT_GT(changed, 300);
}

TEST(MotionZones, OfValueZeroLeaveEveryByte) {
    const ZonedWall shot;
    const ShotPlan plan = make_plan(zoned(ZoneKind::kStiffer, 0));
    MemoryAnalysisStore store;
    analyse(shot, plan, store);
    const ZonedAnalysis seen(shot, plan, store);
    EXPECT_EQ(*seen.get(kPlace), *store.get(kPlace));
}

TEST(MotionZones, LightZonesAndSurfacesThatAreNotFollowedStayAsTheyAre) {
    const ZonedWall shot;
    MemoryAnalysisStore store;
    analyse(shot, make_plan(make_region(sample_texture())), store);
    ASSERT_TRUE(store.put(kPlace, encode(disturbed(place_in(store)))));
    RegionPlan alone = zoned(ZoneKind::kIgnore);
    alone.temporal = TemporalMode::kNone;
    for (const RegionPlan& region : {zoned(ZoneKind::kLight), alone}) {
        const ShotPlan plan = make_plan(region);
        EXPECT_EQ(*ZonedAnalysis(shot, plan, store).get(kPlace), *store.get(kPlace));
    }
}

// A plain board that hides part of the wall and does not move with it: the wall around it does.
TEST(MotionZones, FollowTheSurroundingsOfAPlainBoard) {
    constexpr Recti kBoard{56, 40, 104, 72};
    ZonedWall shot(kBoard);
    for (auto& [frame, plate] : shot.plates) {
        auto painted = std::make_shared<ImageF3>(*plate);
        for (int y = kBoard.y0; y < kBoard.y1; ++y)
            for (int x = kBoard.x0; x < kBoard.x1; ++x)
                std::fill_n(painted->pixel(x, y), 3, 0.4f);
        plate = painted;
        shot.mattes[{0, frame}] = box_matte(kBoard);
    }
    const ShotPlan plan = make_plan(zoned(ZoneKind::kSurroundings));
    MemoryAnalysisStore store;
    analyse(shot, plan, store);
    const Vec2 middle(80, 56);
    const Vec2 truth = wall_moved(middle, kFirst) - wall_moved(middle, kZonedFrame);
    EXPECT_GT(distance(place_in(store).at(middle), truth), 3.0f) << "the board itself stands";
    const ZonedAnalysis seen(shot, plan, store);
    EXPECT_LT(distance(place_in(seen).at(middle), truth), 0.2f);
}

TEST(MotionZones, APinInsideHolds) {
    const ZonedWall shot;
    RegionPlan region = zoned(ZoneKind::kIgnore);
    region.reference_frames = {kFirst, kZonedFrame};
    const ShotPlan unpinned = make_plan(region);
    region.corrections[kZonedFrame] = {
        {{80, 57}, {86, 54}}, {{30, 30}, {30, 30}}, {{130, 90}, {130, 90}}};
    const ShotPlan plan = make_plan(region);
    MemoryAnalysisStore before, after;
    analyse(shot, unpinned, before);
    analyse(shot, plan, after);
    const LatticeField was = place_in(ZonedAnalysis(shot, unpinned, before));
    const LatticeField is = place_in(ZonedAnalysis(shot, plan, after));
    EXPECT_LT(distance(Vec2(86, 54) + is.at({86, 54}), Vec2(80, 57) + was.at({80, 57})), 0.6f);
}

TEST(MotionZones, CalmNeedsTheFramesAround) {
    RegionPlan region = zoned(ZoneKind::kCalmer);
    ShotPlan plan = make_plan(region);
    plan.frames = {5};
    EXPECT_EQ(analysed_span(plan, region).last, 5);
    region.calm_span = {kFirst, 9};
    EXPECT_EQ(analysed_span(plan, region).first, kFirst);
    EXPECT_EQ(analysed_span(plan, region).last, 8) << "the end of the run";
    region.calm_span = {kFirst, 100};
    EXPECT_EQ(analysed_span(plan, region).last, 5 + 8);
}

}  // namespace
}  // namespace weft
