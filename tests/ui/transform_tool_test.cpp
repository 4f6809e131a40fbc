// The transform box: what its handles, the pivot and the arrow keys emit.
#include "tests/ui/canvas_fixture.h"
#include "ui/placement/transform_box.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class TransformTool : public CanvasTest {
  protected:
    void SetUp() override {
        size = {1600, 1400};  // the whole inspector
        CanvasTest::SetUp();
        matte_ = Matte(320, 180);
        for (int y = 40; y < 100; ++y)
            for (int x = 60; x < 120; ++x)
                matte_.at(x, y) = 255;
        RegionMatteView shown;
        shown.region = 1;
        shown.frame = view.frame;
        shown.kind = RegionMatteView::Kind::kPainted;
        shown.pixels = matte_;
        shown.version = 1;
        view.mattes = {shown};
    }
    void change(std::function<void(Region&)> what) {
        view.project.regions[0] = view.project.regions[0].with(what);
        robot->frames(2);
    }
    // The placement after all edits that were done, by one step.
    Placement placed() {
        std::vector<Edit> all;
        int steps = 0;
        for (const DoEdit& one : emitted<DoEdit>()) {
            all.push_back(one.edit);
            ++steps;
        }
        for (const DoEdits& some : emitted<DoEdits>()) {
            all.insert(all.end(), some.edits.begin(), some.edits.end());
            ++steps;
        }
        EXPECT_EQ(steps, 1);
        const auto changed = apply_edits(view.project, all);
        EXPECT_TRUE(changed);
        return changed ? changed->regions[0]->placement : Placement{};
    }
    Matte matte_;
};

TEST_F(TransformTool, ADragInsideMoves) {
    go("Texture", Tool::kPlace);
    robot->stroke({on(100, 80), on(110, 82), on(130, 90)});
    EXPECT_THAT(emitted<TryEdits>(), ::testing::Not(IsEmpty()));
    const Placement now = placed();
    EXPECT_NEAR(now.offset_px.x, 30, 0.6);
    EXPECT_NEAR(now.offset_px.y, 10, 0.6);
    EXPECT_EQ(now.scale, 1);
}

TEST_F(TransformTool, ACornerScalesAboutTheMiddleOfTheBox) {
    go("Texture", Tool::kPlace);
    robot->stroke({on(120, 100), on(130, 110), on(150, 130)});
    const Placement now = placed();
    EXPECT_NEAR(now.scale, 2, 0.03);
    EXPECT_NEAR(now.offset_px.x, -90, 3);
    EXPECT_NEAR(now.offset_px.y, -70, 3);
    EXPECT_EQ(now.rotate_deg, 0);
}

TEST_F(TransformTool, ADragOutsideRotatesAboutThePivot) {
    go("Texture", Tool::kPlace);
    robot->stroke({on(180, 70), on(150, 130), on(90, 160)});  // clockwise
    const Placement now = placed();
    EXPECT_NEAR(now.rotate_deg, -90, 1);
    EXPECT_NEAR(now.offset_px.x, 160, 2);
    EXPECT_NEAR(now.offset_px.y, -20, 2);
}

TEST_F(TransformTool, ThePivotIsMovedAndStaysWhereItIs) {
    go("Texture", Tool::kPlace);
    robot->stroke({on(90, 70), on(80, 60), on(60, 50)});
    EXPECT_THAT(emitted<DoEdits>(), IsEmpty());
    EXPECT_THAT(emitted<DoEdit>(), IsEmpty());
    clear();
    robot->stroke({on(120, 100), on(150, 120), on(180, 150)});
    const Placement now = placed();
    EXPECT_NEAR(now.scale, 2, 0.05);
    EXPECT_NEAR(now.offset_px.x, -60, 3);
    EXPECT_NEAR(now.offset_px.y, -50, 3);
}

TEST_F(TransformTool, KeysOfThisFrameAreWrittenWhereThereAreSome) {
    change([](Region& r) { r.placement.offset_keys = *parse_keyed_numbers("1001:5,5", 2); });
    go("Texture", Tool::kPlace);
    robot->stroke({on(100, 80), on(110, 82), on(130, 90)});
    const Placement now = placed();
    ASSERT_THAT(now.offset_keys.keys, SizeIs(2));
    EXPECT_EQ(now.offset_keys.keys[1].frame, 1003);
    EXPECT_NEAR(now.offset_keys.keys[1].numbers[0], 35, 0.6);
    EXPECT_EQ(now.offset_px.x, 0);
}

TEST_F(TransformTool, TheMouseIsFollowedOnTheSurface) {
    // Seen from the surface, the frame has half the size.
    view.stages.places[1] = std::make_shared<const SurfacePlaces>(
        LatticeField(view.plate.size, 16), TextureMapping(Mat3{0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 1}));
    go("Texture", Tool::kPlace);
    robot->stroke({on(100, 80), on(110, 82), on(130, 90)});
    EXPECT_NEAR(placed().offset_px.x, 15, 0.6);
}

TEST_F(TransformTool, ArrowKeysNudgeInsteadOfSteppingFrames) {
    go("Texture", Tool::kPlace);
    robot->key("Left");
    EXPECT_EQ(placed().offset_px.x, -1);
    clear();
    robot->key("Shift+Down");
    EXPECT_EQ(placed().offset_px.y, 10);
    EXPECT_THAT(emitted<StepFrames>(), IsEmpty());
    clear();
    shell->state().tool = Tool::kPan;
    robot->key("Left");
    EXPECT_THAT(emitted<StepFrames>(), SizeIs(1));
    EXPECT_THAT(emitted<DoEdit>(), IsEmpty());
}

TEST_F(TransformTool, CornersBeginAroundTheRegion) {
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("Perspective"));
    robot->frames(2);
    ASSERT_TRUE(robot->click("Add corner pin"));
    const auto set = edits<SetRegionParameter>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_THAT(std::get<std::vector<double>>(set[0].value),
                ElementsAre(60, 40, 120, 40, 120, 100, 60, 100));
}

TEST_F(TransformTool, CornerPinsBeginOnThePlaneThatWasFoundAndSaySo) {
    view.preview.planes[1] = {{{50, 60}, {150, 60}, {180, 120}, {30, 120}}};
    view.preview.forms[1] = "Plane, from 11 frames of motion, tilted 71° ± 2°";
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("Perspective"));
    robot->frames(2);
    ASSERT_TRUE(robot->click("Add corner pin"));
    const auto set = edits<SetRegionParameter>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_THAT(std::get<std::vector<double>>(set[0].value),
                ElementsAre(50, 60, 150, 60, 180, 120, 30, 120));
    EXPECT_EQ(shell->state().form.pinned_on.at(1), view.preview.forms[1]);
}

// On an anamorphic plate the mouse turns and scales what is seen, unsqueezed, and the offset stays
// in pixels of the plate.
class AnamorphicTransformTool : public TransformTool {
  protected:
    void SetUp() override {
        TransformTool::SetUp();
        view.plate.pixel_aspect = 2;
    }
};

TEST_F(AnamorphicTransformTool, ADragInsideMovesByPixelsOfThePlate) {
    go("Texture", Tool::kPlace);
    ASSERT_EQ(shell->state().viewer.aspect, 2);
    robot->stroke({on(100, 80), on(110, 82), on(130, 90)});
    const Placement now = placed();
    EXPECT_NEAR(now.offset_px.x, 30, 0.6);
    EXPECT_NEAR(now.offset_px.y, 10, 0.6);
}

TEST_F(AnamorphicTransformTool, ADragOutsideTurnsAsTheMouseDoes) {
    go("Texture", Tool::kPlace);
    // About (90, 70), from the right to below it: a quarter turn of what is seen.
    robot->stroke({on(150, 70), on(120, 140), on(90, 190)});
    const Placement now = placed();
    EXPECT_NEAR(now.rotate_deg, -90, 1);
    // The origin, 180 unsqueezed pixels left of the pivot and 70 above it, goes with it.
    EXPECT_NEAR(now.offset_px.x, 90 + 70 / 2.0, 2);
    EXPECT_NEAR(now.offset_px.y, 70 - 180, 2);
}

TEST_F(AnamorphicTransformTool, ACornerScalesAboutTheMiddleOfTheBox) {
    go("Texture", Tool::kPlace);
    robot->stroke({on(120, 100), on(130, 110), on(150, 130)});
    const Placement now = placed();
    EXPECT_NEAR(now.scale, 2, 0.03);
    EXPECT_NEAR(now.offset_px.x, -90, 3);
    EXPECT_NEAR(now.offset_px.y, -70, 3);
}

TEST_F(AnamorphicTransformTool, CornersBeginAroundTheRegion) {
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("Perspective"));
    robot->frames(2);
    ASSERT_TRUE(robot->click("Add corner pin"));
    const auto set = edits<SetRegionParameter>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_THAT(std::get<std::vector<double>>(set[0].value),
                ElementsAre(60, 40, 120, 40, 120, 100, 60, 100));
}

TEST(TransformBox, IsARectangleOfTheUnsqueezedPicture) {
    const PixelAspect aspect(2);
    Matte matte(100, 100);
    for (int y = 30; y < 70; ++y)
        for (int x = 40; x < 60; ++x)
            matte.at(x, y) = 255;
    auto box = ui::box_around(matte, 45, aspect);
    ASSERT_TRUE(box);
    for (Vec2& corner : *box)
        corner = aspect.unsqueezed(corner) - Vec2(100, 50);
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(std::hypot((*box)[k].x, (*box)[k].y), 40, 0.1);
    EXPECT_NEAR((*box)[0].x, -40, 0.1);
    EXPECT_NEAR((*box)[0].y, 0, 0.1);
}

TEST(TransformBox, FollowsTheTexturesAxes) {
    Matte matte(100, 100);
    for (int y = 30; y < 70; ++y)
        for (int x = 30; x < 70; ++x)
            matte.at(x, y) = 255;
    const auto box = ui::box_around(matte, 45);
    ASSERT_TRUE(box);
    // The corners of the square turned by 45° lie √2 · 28.3 px from its middle.
    EXPECT_NEAR(std::hypot((*box)[0].x - 50, (*box)[0].y - 50), 40, 0.1);
    EXPECT_NEAR((*box)[0].x, 10, 0.1);  // the first one on the left
    EXPECT_FALSE(ui::box_around(Matte(10, 10), 0));
}

}  // namespace
}  // namespace weft::test
