// The grid warp tool: what dragged points, handles, boxes and the fields emit.
#include "tests/ui/canvas_fixture.h"
#include "ui/placement/warp_grid.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class WarpTool : public CanvasTest {
  protected:
    void SetUp() override {
        size = {1600, 1600};  // the whole inspector
        CanvasTest::SetUp();
        matte_ = Matte(320, 180);
        for (int y = 30; y < 120; ++y)
            for (int x = 60; x < 150; ++x)
                matte_.at(x, y) = 255;
        RegionMatteView shown;
        shown.region = 1;
        shown.frame = view.frame;
        shown.kind = RegionMatteView::Kind::kPainted;
        shown.pixels = matte_;
        shown.version = 1;
        view.mattes = {shown};
    }
    // Carries out what was emitted last, as the session does.
    void take() {
        for (const DoEdits& one : emitted<DoEdits>()) {
            auto changed = apply_edits(view.project, one.edits);
            ASSERT_TRUE(changed) << changed.error().text();
            view.project = std::move(*changed);
        }
        clear();
        robot->frames(2);
    }
    void lay(const GridWarp& warp) {
        view.project.regions[0] =
            view.project.regions[0].with([&](Region& r) { r.placement.warp = warp; });
        robot->frames(2);
    }
    const std::optional<GridWarp>& warp() const { return view.project.regions[0]->placement.warp; }
    Matte matte_;
};

TEST_F(WarpTool, TheFirstDragLaysAGridOverTheRegion) {
    go("Texture", Tool::kWarp);
    EXPECT_FALSE(warp());
    robot->stroke({on(90, 60), on(93, 62), on(98, 67)});
    EXPECT_THAT(emitted<TryEdits>(), ::testing::Not(IsEmpty()));
    ASSERT_THAT(emitted<DoEdits>(), SizeIs(1));
    EXPECT_EQ(emitted<DoEdits>()[0].label, "Warp texture");
    take();
    ASSERT_TRUE(warp());
    EXPECT_EQ(warp()->columns, 3);
    EXPECT_EQ(warp()->corners[2], glm::dvec2(150, 120));
    EXPECT_NEAR(warp()->points[5].at.x, 98, 0.7);
    EXPECT_NEAR(warp()->points[5].at.y, 67, 0.7);
    EXPECT_EQ(warp()->points[6].at, glm::dvec2(120, 60));
}

TEST_F(WarpTool, ACornerPinIsFollowed) {
    view.project.regions[0] = view.project.regions[0].with([](Region& r) {
        r.placement.corners_px = {PlatePoint{60, 40}, {150, 50}, {140, 110}, {60, 120}};
    });
    go("Texture", Tool::kWarp);
    robot->stroke({on(150, 50), on(151, 52), on(155, 53)});
    take();
    ASSERT_TRUE(warp());
    EXPECT_EQ(warp()->corners[1], glm::dvec2(150, 50));
    EXPECT_NEAR(warp()->points[3].at.x, 155, 0.7);
}

TEST_F(WarpTool, AClickSelectsAndMovesNothing) {
    go("Texture", Tool::kWarp);
    click_at(on(90, 60));
    EXPECT_THAT(emitted<DoEdits>(), IsEmpty());
    EXPECT_THAT(shell->state().warp.selected, ElementsAre(5U));
}

TEST_F(WarpTool, SeveralPointsMoveTogether) {
    go("Texture", Tool::kWarp);
    robot->stroke({on(80, 50), on(100, 70), on(130, 70)});  // a box around points 6 and 7
    EXPECT_THAT(shell->state().warp.selected, ElementsAre(5U, 6U));
    EXPECT_THAT(emitted<DoEdits>(), IsEmpty());
    robot->stroke({on(120, 60), on(120, 63), on(120, 68)});
    take();
    ASSERT_TRUE(warp());
    EXPECT_NEAR(warp()->points[5].at.y, 68, 0.7);
    EXPECT_NEAR(warp()->points[6].at.y, 68, 0.7);
    EXPECT_EQ(warp()->points[9].at.y, 90);
}

TEST_F(WarpTool, ArrowKeysNudgeTheSelectedPoints) {
    go("Texture", Tool::kWarp);
    click_at(on(90, 60));
    robot->key("Right");
    EXPECT_THAT(emitted<StepFrames>(), IsEmpty());
    take();
    ASSERT_TRUE(warp());
    EXPECT_NEAR(warp()->points[5].at.x, 91, 1e-4);
    robot->key("Shift+Up");
    take();
    EXPECT_NEAR(warp()->points[5].at.y, 50, 1e-4);
}

TEST_F(WarpTool, ADragStopsAtTheFold) {
    go("Texture", Tool::kWarp);
    robot->stroke({on(90, 60), on(120, 60), on(170, 60)});
    take();
    ASSERT_TRUE(warp());
    EXPECT_TRUE(check_grid_warp(*warp()));
    EXPECT_GT(warp()->points[5].at.x, 95);
    EXPECT_LT(warp()->points[5].at.x, 125);
}

TEST_F(WarpTool, HandlesMoveTogetherUnlessTheyAreBroken) {
    go("Texture", Tool::kWarp);
    click_at(on(90, 60));
    robot->frames(2);
    robot->stroke({on(100, 60), on(101, 63), on(102, 66)});  // its right handle
    take();
    ASSERT_TRUE(warp());
    const WarpPoint& at = warp()->points[5];
    ASSERT_TRUE(at.left && at.right);
    EXPECT_NEAR(at.right->y, 6, 0.7);
    EXPECT_EQ(*at.left, -*at.right);
    EXPECT_FALSE(at.up);
    robot->frames(2);
    ASSERT_TRUE(robot->click("Warp/Smooth points"));
    take();
    EXPECT_FALSE(warp()->points[5].left);
}

TEST_F(WarpTool, OnAnotherFrameItIsDraggedWhereTheSurfaceIs) {
    LatticeField moved(view.plate.size, 16);
    for (int j = 0; j < moved.nodes().height(); ++j)
        for (int i = 0; i < moved.nodes().width(); ++i)
            moved.set_node(i, j, Vec2(-20, 0));
    view.stages.places[1] = std::make_shared<const SurfacePlaces>(moved, TextureMapping());
    lay(ui::laid_grid({Vec2(40, 30), Vec2(130, 30), Vec2(130, 120), Vec2(40, 120)}));
    go("Texture", Tool::kWarp);
    robot->stroke({on(90, 60), on(92, 62), on(96, 64)});  // the point at 70, 60
    take();
    EXPECT_NEAR(warp()->points[5].at.x, 76, 0.7);
    EXPECT_NEAR(warp()->points[5].at.y, 64, 0.7);
}

TEST_F(WarpTool, KeysOfThisFrameAreWrittenWhereThereAreSome) {
    GridWarp grid = ui::laid_grid({Vec2(60, 30), Vec2(150, 30), Vec2(150, 120), Vec2(60, 120)});
    set_key(grid, 1001, grid.points);
    lay(grid);
    go("Texture", Tool::kWarp);
    robot->stroke({on(90, 60), on(93, 62), on(98, 67)});
    take();
    ASSERT_THAT(warp()->keys, SizeIs(2));
    EXPECT_EQ(warp()->keys[1].first, view.frame);
    EXPECT_NEAR(warp()->keys[1].second[5].at.x, 98, 0.7);
    EXPECT_EQ(warp()->points, grid.points);
    ASSERT_TRUE(robot->click("Warp/Remove key"));
    take();
    EXPECT_THAT(warp()->keys, SizeIs(1));
    ASSERT_TRUE(robot->click("Warp/Key here"));
    take();
    EXPECT_THAT(warp()->keys, SizeIs(2));
}

TEST_F(WarpTool, ResetTakesItAway) {
    lay(ui::laid_grid({Vec2(60, 30), Vec2(150, 30), Vec2(150, 120), Vec2(60, 120)}));
    go("Texture", Tool::kWarp);
    ASSERT_TRUE(robot->click("Warp/Reset warp"));
    take();
    EXPECT_FALSE(warp());
}

}  // namespace
}  // namespace weft::test
