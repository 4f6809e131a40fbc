// Each struct of a region's parameters, as the pipeline gets it.
#include "app/shot/region_projection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

MatteSource painted_on(std::initializer_list<int> frames) {
    MatteSource out;
    for (const int frame : frames)
        out.keyframes[frame] = {"m.png"};
    return out;
}

TEST(RegionProjection, PaintedHoldoutsKeepTheirOrderAmongThePainted) {
    MatteSource matte = painted_on({7, 3});
    matte.steadiness = 0.25;
    matte.propagate_to = 20;
    MatteSource files;
    files.files = "holdout.####.png";
    RegionPlan plan;
    ASSERT_TRUE(project_mattes(matte, {painted_on({5}), files, painted_on({1, 9})}, plan));
    EXPECT_THAT(plan.matte_keys, ElementsAre(3, 7));
    EXPECT_FLOAT_EQ(plan.matte_steadiness, 0.25f);
    EXPECT_EQ(plan.matte_reach.last, 20);
    EXPECT_TRUE(plan.has_holdout) << "the one in files";
    ASSERT_EQ(plan.painted_holdouts.size(), 2u);
    EXPECT_THAT(plan.painted_holdouts[0].keys, ElementsAre(5));
    EXPECT_THAT(plan.painted_holdouts[1].keys, ElementsAre(1, 9));
}

TEST(RegionProjection, EveryMatteHasItsOwnEdgeTools) {
    MatteSource matte = painted_on({3}), painted = painted_on({5}), files;
    files.files = "holdout.####.png";
    matte.edge.choke_px = 2.5;
    matte.edge.blur_keys = {{{1, {0}}, {5, {4}}}};
    painted.edge.feather_px = -3;
    files.edge.min_hole_px = 20;
    RegionPlan plan;
    ASSERT_TRUE(project_mattes(matte, {painted, files}, plan));
    EXPECT_EQ(plan.matte_edge.at(3).choke_px, 2.5f);
    EXPECT_EQ(plan.matte_edge.at(3).blur_px, 2);
    ASSERT_EQ(plan.given_holdout_edges.size(), 1u);
    EXPECT_EQ(plan.given_holdout_edges[0].edge.min_hole_px, 20);
    EXPECT_EQ(plan.painted_holdouts[0].edge.edge.feather_px, -3);
    Zone zone;
    zone.matte = matte;
    ASSERT_TRUE(project_zones({zone}, plan));
    EXPECT_EQ(plan.zones[0].edge.edge.choke_px, 2.5f);
    EXPECT_TRUE(project_edge({}).none());
}

TEST(RegionProjection, AMatteAndAHoldoutMustBeThere) {
    RegionPlan plan;
    const Status none = project_mattes({}, {}, plan);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::kUsage);
    const Status empty = project_mattes(painted_on({1}), {MatteSource{}}, plan);
    ASSERT_FALSE(empty);
    EXPECT_THAT(empty.error().text(), HasSubstr("holdout"));
}

TEST(RegionProjection, CorrectedFramesBecomeReferenceFramesOnce) {
    RegionPlan plan;
    plan.reference_frames = {10, 4};
    project_corrections({{4, {{{1, 2}, {3, 4}}}}, {8, {{{5, 6}, {7, 8}}}}}, plan);
    EXPECT_THAT(plan.reference_frames, ElementsAre(10, 4, 8)) << "the first holds the placement";
    ASSERT_EQ(plan.corrections.at(8).size(), 1u);
    EXPECT_EQ(plan.corrections.at(8)[0].to, Vec2(7, 8));
}

TEST(RegionProjection, MotionComesFromFilesOrFromATrack) {
    MotionSource motion;
    motion.files = "motion.####.exr";
    motion.direction = MotionDirection::kBackward;
    RegionPlan plan;
    ASSERT_TRUE(project_motion(motion, plan));
    EXPECT_TRUE(plan.true_motion);
    EXPECT_FALSE(plan.motion_forward);
    motion.track = "corners.nk";
    const Status both = project_motion(motion, plan);
    ASSERT_FALSE(both);
    EXPECT_EQ(both.error().code, ErrorCode::kUsage);
}

TEST(RegionProjection, APlaneIsMadeForTheSmallestKeyedScale) {
    Placement placement;
    placement.scale = 3;
    placement.scale_keys.keys = {{1, {2.0}}, {5, {0.5}}, {9, {4.0}}};
    RegionPlan plan;
    ASSERT_TRUE(project_placement(placement, TemporalMode::kLocked, {}, plan));
    EXPECT_FLOAT_EQ(plan.placement.scale, 0.5f);
    EXPECT_FLOAT_EQ(plan.placement_at(9).scale, 4.0f);
    const Status moving = project_placement(placement, TemporalMode::kPaper, {}, plan);
    ASSERT_FALSE(moving);
    EXPECT_THAT(moving.error().text(), HasSubstr("animated placement"));
    Placement uv;
    uv.uv = "uv.####.exr";
    RegionPlan mapped;
    ASSERT_TRUE(project_placement(uv, TemporalMode::kLocked, {}, mapped));
    EXPECT_TRUE(mapped.has_uv);
    EXPECT_FALSE(project_placement(uv, TemporalMode::kNone, {}, mapped));
}

TEST(RegionProjection, AKeyedFormCountsWhereAnyKeyShowsIt) {
    Region region;
    region.form.source = FormSource::kShape;
    region.form.shape = {{FormGuideKind::kBall, {50, 50, 20}}};
    region.form.amount = 1;
    region.form.amount_keys.keys = {{1, {0.0}}, {11, {0.5}}};
    RegionPlan plan;
    ASSERT_TRUE(project_form(region, plan));
    EXPECT_FLOAT_EQ(plan.form_amount, 0.5f);
    EXPECT_FLOAT_EQ(plan.form_amount_at(6), 0.25f);
    EXPECT_EQ(plan.form_from, RegionPlan::FormFrom::kShape);
    region.form.amount_keys.keys = {{1, {0.0}}, {11, {0.0}}};
    RegionPlan flat;
    ASSERT_TRUE(project_form(region, flat));
    EXPECT_EQ(flat.form_from, RegionPlan::FormFrom::kNothing);
}

TEST(RegionProjection, AShapeIsAMatteOfEveryFrame) {
    MatteSource drawn;
    drawn.shape.keys[3].points.resize(3);
    RegionPlan plan;
    ASSERT_TRUE(project_mattes(drawn, {drawn}, plan));
    EXPECT_FALSE(plan.propagated());
    EXPECT_TRUE(plan.has_holdout);
    EXPECT_TRUE(plan.painted_holdouts.empty());
    Zone zone;
    zone.matte = drawn;
    ASSERT_TRUE(project_zones({zone}, plan));
    EXPECT_FALSE(plan.zones[0].propagated());
}

TEST(RegionProjection, GainsAreLimitedOnADisplayReferredPlateOnly) {
    RegionPlan display, scene;
    ASSERT_TRUE(project_light({}, true, display));
    EXPECT_GT(display.light.least_gain, 0);
    EXPECT_LT(display.light.most_gain, std::numeric_limits<float>::max());
    ASSERT_TRUE(project_light({}, false, scene));
    EXPECT_EQ(scene.light.least_gain, 0);
    EXPECT_EQ(scene.light.most_gain, std::numeric_limits<float>::max());
}

TEST(RegionProjection, LightNeedsWhatItsSourceIsMadeOf) {
    LightParams light;
    light.source = LightSource::kPainted;
    RegionPlan plan;
    EXPECT_FALSE(project_light(light, true, plan)) << "no lamps";
    light.source = LightSource::kPlate;
    light.exact = true;
    EXPECT_FALSE(project_light(light, true, plan)) << "no pass";
    light.albedo = "albedo.####.exr";
    ASSERT_TRUE(project_light(light, true, plan));
    EXPECT_EQ(plan.light_pass, RegionPlan::Pass::kAlbedo);
    light.lighting = "light.####.exr";
    ASSERT_TRUE(project_light(light, true, plan));
    EXPECT_EQ(plan.light_pass, RegionPlan::Pass::kLighting);
}

TEST(RegionProjection, DraftsHaveGrainAndFocusButNoMotionBlur) {
    FinishParams finish;
    finish.grain = 0.5;
    finish.depth = "depth.####.exr";
    RegionPlan final, draft;
    project_finish(finish, FlowQuality::kFinal, final);
    EXPECT_FLOAT_EQ(final.grain, 0.5f);
    EXPECT_TRUE(final.has_depth);
    EXPECT_EQ(final.shutter_deg, std::nullopt) << "to be measured";
    project_finish(finish, FlowQuality::kDraft, draft);
    EXPECT_FLOAT_EQ(draft.grain, 0.5f);
    EXPECT_FLOAT_EQ(draft.focus, 1.0f);
    EXPECT_TRUE(draft.has_depth);
    EXPECT_EQ(draft.shutter_deg, 0.0f);
    finish.shutter_deg = 180;
    project_finish(finish, FlowQuality::kFinal, final);
    EXPECT_EQ(final.shutter_deg, 180.0f);
}

TEST(RegionProjection, InkIsExtractedWhereThereIsNoPass) {
    LineParams lines;
    lines.extract = true;
    RegionPlan plan;
    project_lines(lines, plan);
    EXPECT_TRUE(plan.extract_lines);
    lines.files = "ink.####.png";
    project_lines(lines, plan);
    EXPECT_TRUE(plan.has_lines);
    EXPECT_FALSE(plan.extract_lines);
}

}  // namespace
}  // namespace weft::test
