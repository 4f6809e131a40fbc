// ST-maps between the reference frame and another: where they point, what they show, and that one
// undoes the other.
#include "engine/pipeline/st_maps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

constexpr int kMappedFrame = 5;

// A frame whose surface lies as `field` says.
struct Shown {
    MemoryShot shot{kShotSize};
    MemoryAnalysisStore store;
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));

    explicit Shown(const LatticeField& ref_from_cur) {
        shot.mattes[{0, kMappedFrame}] = box_matte(kRegionBox);
        EXPECT_TRUE(store.put({0, kMappedFrame, AnalysisKind::kCoords}, encode(ref_from_cur)));
    }
    [[nodiscard]] StMaps maps() const {
        const auto found = st_maps(shot, make_plan(region), store, kMappedFrame);
        EXPECT_TRUE(found) << (found ? "" : found.error().text());
        return found ? *found : StMaps{};
    }
};

LatticeField field_of(const std::function<Vec2(Vec2)>& displacement) {
    LatticeField field(kShotSize, 8);
    for (int j = 0; j < field.nodes().height(); ++j)
        for (int i = 0; i < field.nodes().width(); ++i)
            field.set_node(i, j, displacement(field.node_position(i, j)));
    return field;
}

// Turned by 25°, smaller, and bent.
Vec2 bent(Vec2 p) {
    const Vec2 c(80, 56), d = p - c;
    const Vec2 turned(0.73f * d.x + 0.34f * d.y, -0.34f * d.x + 0.73f * d.y);
    return c + turned + 3.0f * Vec2(std::sin(0.06f * p.y), std::cos(0.05f * p.x)) - p;
}

Vec2 mapped_place(const StMap& map, int x, int y) {
    const float* st = map.st.pixel(x, y);
    return {st[0] * kShotSize.width, (1 - st[1]) * kShotSize.height};
}

// Between the centres of pixels, as a compositor reads an ST-map.
Vec2 place_at(const StMap& map, Vec2 at) {
    const int x = static_cast<int>(std::floor(at.x - 0.5f)),
              y = static_cast<int>(std::floor(at.y - 0.5f));
    const float u = at.x - 0.5f - static_cast<float>(x), v = at.y - 0.5f - static_cast<float>(y);
    return (1 - v) * ((1 - u) * mapped_place(map, x, y) + u * mapped_place(map, x + 1, y)) +
           v * ((1 - u) * mapped_place(map, x, y + 1) + u * mapped_place(map, x + 1, y + 1));
}

// Whether the four pixels around a place are seen in full.
bool shown_at(const StMap& map, Vec2 at) {
    const int x = static_cast<int>(std::floor(at.x - 0.5f)),
              y = static_cast<int>(std::floor(at.y - 0.5f));
    if (x < 0 || y < 0 || x + 1 >= kShotSize.width || y + 1 >= kShotSize.height) return false;
    return map.visible.at(x, y) == 1 && map.visible.at(x + 1, y) == 1 &&
           map.visible.at(x, y + 1) == 1 && map.visible.at(x + 1, y + 1) == 1;
}

TEST(StMaps, HaveTheirOriginAtTheLowerLeftAndHalfAPixelAtCentres) {
    const StMaps maps = Shown(field_of([](Vec2) { return Vec2(0); })).maps();
    for (const StMap* map : {&maps.warp, &maps.stabilize}) {
        const float* st = map->st.pixel(40, 30);
        EXPECT_NEAR(st[0], 40.5f / 160, 1e-6f);
        EXPECT_NEAR(st[1], 1 - 30.5f / 112, 1e-6f);
        EXPECT_EQ(map->visible.at(40, 30), 1);
        EXPECT_EQ(map->visible.at(2, 2), 0) << "outside of the matte";
        EXPECT_EQ(map->st.pixel(2, 2)[0], 0);
    }
}

TEST(StMaps, WarpGivesThePlaceOnTheReferenceFrame) {
    const StMaps maps = Shown(field_of([](Vec2) { return Vec2(-7.5f, 4); })).maps();
    EXPECT_LT(glm::length(mapped_place(maps.warp, 60, 50) - Vec2(53, 54.5f)), 1e-3f);
    EXPECT_LT(glm::length(mapped_place(maps.stabilize, 60, 50) - Vec2(68, 46.5f)), 1e-3f);
}

// Each undoes the other to a tenth of a pixel where the surface is visible.
TEST(StMaps, ThereAndBackIsWhereItBegan) {
    const StMaps maps = Shown(field_of(bent)).maps();
    int compared = 0;
    float cur = 0, ref = 0;
    for (int y = 0; y < kShotSize.height; ++y) {
        for (int x = 0; x < kShotSize.width; ++x) {
            const Vec2 here(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const Vec2 there = mapped_place(maps.warp, x, y),
                       seen = mapped_place(maps.stabilize, x, y);
            if (maps.warp.visible.at(x, y) == 1 && shown_at(maps.stabilize, there)) {
                cur = std::max(cur, glm::length(place_at(maps.stabilize, there) - here));
                ++compared;
            }
            if (maps.stabilize.visible.at(x, y) == 1 && shown_at(maps.warp, seen))
                ref = std::max(ref, glm::length(place_at(maps.warp, seen) - here));
        }
    }
    EXPECT_GT(compared, 5000);
    EXPECT_LT(cur, 0.1f);
    EXPECT_LT(ref, 0.1f);
    EXPECT_GT(ref, 0) << "both directions were compared";
}

TEST(StMaps, AHoldoutIsNotVisibleInEither) {
    Shown shown(field_of([](Vec2) { return Vec2(-10, 0); }));
    Matte front(kShotSize);
    for (int y = 40; y < 60; ++y)
        std::fill(front.row(y) + 70, front.row(y) + 90, 255);
    shown.shot.holdouts[{0, kMappedFrame}] = front;
    shown.region.has_holdout = true;
    const StMaps maps = shown.maps();
    EXPECT_EQ(maps.warp.visible.at(80, 50), 0);
    EXPECT_EQ(maps.warp.visible.at(80, 70), 1);
    EXPECT_EQ(maps.stabilize.visible.at(70, 50), 0) << "where the holdout lies on the surface";
    EXPECT_EQ(maps.stabilize.visible.at(90, 50), 1);
}

// A place that no place of the frame shows.
TEST(StMaps, WhatIsFoldedAwayIsNotVisible) {
    const StMaps maps =
        Shown(field_of([](Vec2 p) { return Vec2(std::abs(p.x - 80) - (p.x - 80), 0); })).maps();
    EXPECT_EQ(maps.stabilize.visible.at(50, 50), 0);
    EXPECT_GT(maps.stabilize.visible.at(110, 50), 0);
}

TEST(StMaps, AFrameThatWasNotFollowedIsAnError) {
    const Shown shown(field_of([](Vec2) { return Vec2(0); }));
    const MemoryAnalysisStore nothing;
    EXPECT_TRUE(st_maps(shown.shot, make_plan(shown.region), shown.store, kMappedFrame));
    EXPECT_FALSE(st_maps(shown.shot, make_plan(shown.region), nothing, kMappedFrame));
}

}  // namespace
}  // namespace weft
