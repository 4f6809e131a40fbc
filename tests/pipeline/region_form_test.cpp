// A position pass gives a region its form.
#include "engine/pipeline/region_form.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/form_pass.h"
#include "engine/pipeline/provisional.h"
#include "engine/pipeline/region_scene.h"
#include "tests/form/room_picture.h"
#include "tests/pipeline/column_shot.h"

namespace weft {
namespace {

float step_x(const TextureMapping& mapping, float x) {
    return mapping.texel({x + 1, 56}).x - mapping.texel({x - 1, 56}).x;
}

// How much longer a step is at x than at the axis.
float widened(const ShotSource& shot, const RegionPlan& region, float x) {
    MemoryAnalysisStore store;
    const ShotPlan plan = make_plan(region, kFirst, kFirst);
    const Status analysed = analyse_shot(shot, plan, store, {}, {});
    EXPECT_TRUE(analysed) << (analysed ? "" : analysed.error().text());
    const auto scene = make_scene(shot, plan, store, 0, {}, {});
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
    return scene ? step_x(scene->mapping, x) / step_x(scene->mapping, 80) : 0;
}

TEST(RegionForm, IsInTheScenesMapping) {
    RegionPlan region = formed();
    // 50 px from the axis the surface is seen at a cosine of 0.78.
    EXPECT_NEAR(widened(Column(), region, 30), 1 / 0.78f, 0.04f);
    region.form_amount = 0.5f;
    EXPECT_NEAR(widened(Column(), region, 30), 1.13f, 0.03f);
    region.form_amount = 0;
    EXPECT_EQ(region_form(region, MemoryAnalysisStore(), 0).value(), nullptr);
}

TEST(RegionForm, FramesKeepIt) {
    MemoryAnalysisStore store;
    RegionPlan region = formed();
    ASSERT_TRUE(analyse_shot(Column(), make_plan(region), store, {}, {}));
    region.scale_keys = {{{1, {2}}}};
    const auto scene = make_scene(Column(), make_plan(region), store, 0, {}, {});
    ASSERT_TRUE(scene) << scene.error().text();
    EXPECT_NE(scene->mapping.form(), nullptr);
    EXPECT_EQ(mapping_on(region, *scene, 4)->form(), scene->mapping.form());
}

// Between flat and form, on every frame as its amount is there: without a jump.
TEST(RegionForm, ItsAmountMayHaveKeys) {
    MemoryAnalysisStore store;
    RegionPlan region = formed();
    const Column shot;
    ASSERT_TRUE(analyse_shot(shot, make_plan(region), store, {}, {}));
    const auto whole = make_scene(shot, make_plan(region), store, 0, {}, {});
    ASSERT_TRUE(whole);
    region.form_amount_keys = {{{1, {0}}, {9, {1}}}};
    const auto scene = make_scene(shot, make_plan(region), store, 0, {}, {});
    ASSERT_TRUE(scene);
    const Vec2 place(30, 56);
    const Vec2 flat = scene->mapping.with_form(nullptr).texel(place);
    const Vec2 formed_there = whole->mapping.texel(place);
    ASSERT_GT(distance(flat, formed_there), 1.0f);
    for (int frame = 0; frame <= 10; ++frame) {
        const float share = std::clamp(static_cast<float>(frame - 1) / 8, 0.0f, 1.0f);
        const Vec2 there = mapping_on(region, *scene, frame)->texel(place);
        EXPECT_LT(distance(there, flat + share * (formed_there - flat)), 1e-3f) << frame;
    }
    region.form_amount_keys = {{{1, {1}}}};
    EXPECT_EQ(mapping_on(region, *scene, 5)->texel(place), formed_there);
    region.form_amount_keys = {};
    region.form_amount = 0.5f;
    const auto half = make_scene(shot, make_plan(region), store, 0, {}, {});
    region.form_amount_keys = {{{1, {0.5}}}};
    EXPECT_EQ(mapping_on(region, *scene, 5)->texel(place), half->mapping.texel(place));
}

// The matte begins at 20: 12 is seen on the last frames only, where the picture has panned.
TEST(RegionForm, WhatComesIntoViewIsFoundOnLaterFrames) {
    constexpr float kAt = 12, kTrue = 1 / 0.527f;
    const float first = widened(Column(), formed(), kAt);
    const float clip = widened(Column(), formed({1, 4, 7, 10}), kAt);
    EXPECT_NEAR(clip, kTrue, 0.12f);
    EXPECT_LT(std::abs(clip - kTrue), 0.5f * std::abs(first - kTrue)) << first << " and " << clip;
}

// A tiled room before a camera that stands still.
MemoryShot still_room(const RoomPicture& room, int frames) {
    MemoryShot shot(RoomPicture::kSize);
    auto plate = std::make_shared<ImageF3>(RoomPicture::kSize);
    for (int y = 0; y < RoomPicture::kSize.height; ++y)
        for (int x = 0; x < RoomPicture::kSize.width; ++x)
            std::fill_n(plate->pixel(x, y), 3, static_cast<float>(room.luma.at(x, y)) / 255.0f);
    for (int frame = kFirst; frame < kFirst + frames; ++frame) {
        shot.plates[frame] = plate;
        shot.mattes[{0, frame}] = room.floor;
    }
    return shot;
}

FormFinding found_in(const MemoryShot& shot, RegionPlan region, int frames) {
    region.form_from = RegionPlan::FormFrom::kMotion;
    region.form_evidence.clear();
    for (int frame = kFirst; frame < kFirst + frames; ++frame)
        region.form_evidence.push_back(frame);
    MemoryAnalysisStore store;
    const Status analysed =
        analyse_shot(shot, make_plan(region, kFirst, kFirst + frames - 1), store, {}, {});
    EXPECT_TRUE(analysed) << (analysed ? "" : analysed.error().text());
    const auto bytes = store.get({0, kFirst, AnalysisKind::kForm});
    return bytes ? decode_form(*bytes)->finding : FormFinding();
}

TEST(RegionForm, LinesShowItWhereTheCameraStandsStill) {
    const RoomPicture room;
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    for (const int frames : {1, 4}) {
        const MemoryShot shot = still_room(room, frames);
        const FormFinding found = found_in(shot, region, frames);
        EXPECT_EQ(found.source, FormFinding::Source::kLines) << frames;
        EXPECT_TRUE(found.plane);
        EXPECT_GT(found.belief, 0.9f);
        // The floor's normal is (0, 1, 0), turned by the camera's pitch.
        EXPECT_NEAR(found.tilt_deg, 64, 8) << frames;
        EXPECT_NEAR(found.fov_deg, 56, 4) << frames;
    }
    region.surface = SurfaceKind::kCloth;
    EXPECT_EQ(found_in(still_room(room, 1), region, 1).source, FormFinding::Source::kNone);
}

TEST(RegionForm, APassWithoutFormIsAnError) {
    Column shot;
    shot.constant = true;
    MemoryAnalysisStore store;
    Status found = analyse_shot(shot, make_plan(formed()), store, {}, {});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(found.error().sentence(), ::testing::HasSubstr("frame 1:"));
    shot.constant = false;
    shot.missing = 7;
    found = analyse_shot(shot, make_plan(formed({1, 4, 7, 10})), store, {}, {});
    ASSERT_FALSE(found) << "never other bytes";
    EXPECT_THAT(found.error().sentence(), ::testing::HasSubstr("frame 7"));
    EXPECT_FALSE(store.has({0, kFirst, AnalysisKind::kForm}));
}

TEST(RegionForm, FollowsADrawnShape) {
    const FormGuide column{FormGuideKind::kCylinder, {80, 0, 80, 112, 80, 80}};
    EXPECT_NEAR(widened(Column(), drawn(column), 30), 1 / 0.78f, 0.04f);
}

// The column's normals, carried along as it pans; a flat region shows none.
TEST(RegionForm, LayersShowItsNormalsOnEveryFrame) {
    RegionPlan region = drawn({FormGuideKind::kCylinder, {80, 0, 80, 112, 80, 80}});
    MemoryAnalysisStore store;
    const Column shot;
    const ShotPlan plan = make_plan(region);
    ASSERT_TRUE(analyse_shot(shot, plan, store, {}, {}));
    auto scene = make_scene(shot, plan, store, 0, {}, {});
    ASSERT_TRUE(scene) << scene.error().text();
    const Recti box = rect_of(kShotSize);
    const Matte all(kShotSize, 255);
    for (const int frame : {kFirst, 5}) {
        const auto shown = region_form_on(*scene, store, 0, frame, all, box);
        ASSERT_TRUE(shown);
        const Vec2 panned = wall_moved({0, 0}, frame) - wall_moved({0, 0}, kFirst);
        const int x = static_cast<int>(80 + panned.x), y = static_cast<int>(56 + panned.y);
        EXPECT_NEAR(shown->normal.at(x, y, 2), 1, 0.03f) << frame;
        EXPECT_NEAR(shown->normal.at(x + 40, y, 0), 0.5f, 0.06f) << frame;
        EXPECT_NEAR(shown->normal.at(x - 40, y, 0), -0.5f, 0.06f) << frame;
        EXPECT_GT(shown->depth.at(x + 40, y), shown->depth.at(x, y));
        EXPECT_GT(shown->confidence.at(x, y), 0.9f) << frame;
    }
    scene->form = nullptr;
    EXPECT_EQ(region_form_on(*scene, store, 0, 5, all, box)->confidence.at(80, 56), 0);
}

TEST(RegionForm, AnOutlineIsInflated) {
    RegionPlan region = formed();
    region.form_from = RegionPlan::FormFrom::kOutline;
    const Column shot;
    const float round = widened(shot, region, 30);
    EXPECT_GT(round, 1.03f);
    region.form_roundness = 0.2f;
    EXPECT_LT(widened(shot, region, 30), round);
    region.form_guides = {{FormGuideKind::kCut, {900, 900, 950, 950}}};
    MemoryAnalysisStore store;
    const Status found = analyse_shot(shot, make_plan(region), store, {}, {});
    ASSERT_FALSE(found);
    EXPECT_THAT(found.error().sentence(), ::testing::HasSubstr("off the region's outline"));
}

TEST(RegionForm, ALevelStrokeTurnsIt) {
    RegionPlan region = drawn({FormGuideKind::kCylinder, {80, 0, 80, 112, 80, 80}});
    region.form_guides.push_back({FormGuideKind::kLevel, {70, 50, 90, 60}});
    MemoryAnalysisStore store;
    const Column shot;
    ASSERT_TRUE(analyse_shot(shot, make_plan(region), store, {}, {}));
    const auto form = region_form(region, store, 0);
    ASSERT_TRUE(form);
    const Vec2 along = (*form)->flat({90, 60}) - (*form)->flat({70, 50});
    EXPECT_NEAR(along.y, 0, 0.01f * along.x);
}

TEST(RegionForm, ADrawingOutsideOfTheRegionIsAnError) {
    const auto refused = [](FormGuide guide) {
        MemoryAnalysisStore store;
        const Column shot;
        const Status found = analyse_shot(shot, make_plan(drawn(std::move(guide))), store, {}, {});
        EXPECT_FALSE(found);
        return found ? std::string() : found.error().sentence();
    };
    EXPECT_THAT(refused({FormGuideKind::kBall, {900, 900, 20}}),
                ::testing::HasSubstr("does not lie on the region"));
    EXPECT_THAT(refused({FormGuideKind::kParallel, {900, 900, 950, 900, 900, 950, 950, 960}}),
                ::testing::AllOf(::testing::HasSubstr("outside of the region"),
                                 ::testing::EndsWith("Draw it on the surface (form.strokes).")));
    EXPECT_THAT(refused({FormGuideKind::kParallel, {40, 40, 90, 80, 40, 80, 90, 40}}),
                ::testing::HasSubstr("cross each other"));
}

// A wall that only moves past could have any form.
TEST(RegionForm, WhatMotionDoesNotTellIsFlatAndSaysHowManyFramesWereCompared) {
    const auto finding = [](std::vector<int> evidence) {
        RegionPlan region = formed(std::move(evidence));
        region.form_from = RegionPlan::FormFrom::kMotion;
        MemoryAnalysisStore store;
        const Column shot;
        EXPECT_TRUE(analyse_shot(shot, make_plan(region), store, {}, {}));
        const auto form = decode_form(store.get({0, kFirst, AnalysisKind::kForm}).value());
        EXPECT_TRUE(form);
        EXPECT_EQ(region_form(region, store, 0).value(), nullptr);
        return form ? form->finding : FormFinding();
    };
    const FormFinding several = finding({1, 4, 7, 10});
    EXPECT_EQ(several.source, FormFinding::Source::kNone);
    EXPECT_EQ(several.frames, 3);
    const FormFinding alone = finding({1});
    EXPECT_EQ(alone.source, FormFinding::Source::kNone);
    EXPECT_EQ(alone.frames, 0);
    EXPECT_EQ(alone.belief, 0);
}

// Another form does not make the surface be followed again.
TEST(RegionForm, IsAStageOfItsOwn) {
    MemoryAnalysisStore store;
    const Column shot;
    ASSERT_TRUE(analyse_shot(shot, make_plan(make_region(flat_texture({1, 1, 1}))), store, {}, {}));
    const int read = shot.plates_read();
    ASSERT_TRUE(analyse_shot(shot, make_plan(formed({1, 4, 7, 10})), store, {}, {}));
    EXPECT_EQ(shot.plates_read(), read);
    EXPECT_TRUE(store.has({0, kFirst, AnalysisKind::kForm}));
}

// Before the clip has been followed, the reference frame's form shows.
TEST(RegionForm, IsThereAtOnceInAProvisionalPicture) {
    const Column shot;
    const ShotPlan plan = make_plan(formed({1, 4, 7, 10}));
    const MemoryAnalysisStore nothing;
    const auto shown = provisional_frame(shot, plan, nothing, kFirst, {}, {});
    ASSERT_TRUE(shown) << shown.error().text();
    const auto scene = make_scene(shot, shown->plan, *shown->store, 0, {}, {});
    ASSERT_TRUE(scene) << scene.error().text();
    EXPECT_NEAR(step_x(scene->mapping, 30) / step_x(scene->mapping, 80), 1 / 0.78f, 0.04f);
}

}  // namespace
}  // namespace weft
