// Esc in the middle of a drag: all is as it was before. And lines that undo takes away.
#include "tests/ui/canvas_fixture.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class TakeBack : public CanvasTest {
  protected:
    void SetUp() override {
        size = {1600, 1400};  // the whole inspector
        CanvasTest::SetUp();
        RegionMatteView shown;
        shown.region = 1;
        shown.frame = view.frame;
        shown.kind = RegionMatteView::Kind::kPainted;
        matte_ = Matte(320, 180);
        for (int y = 40; y < 100; ++y)
            for (int x = 60; x < 120; ++x)
                matte_.at(x, y) = 255;
        shown.pixels = matte_;
        shown.version = 1;
        view.mattes = {shown};
    }
    void change(const std::function<void(Region&)>& what) {
        view.project.regions[0] = view.project.regions[0].with(what);
        robot->frames(2);
    }
    // Drags and presses Esc before the button is let go.
    void drag_and_escape(ImVec2 from, ImVec2 to) {
        robot->move(from);
        robot->press();
        robot->move({(from.x + to.x) / 2, (from.y + to.y) / 2});
        robot->move(to);
        robot->frames(2);
        robot->key("Esc");
        robot->move({to.x + 9, to.y + 9});
        robot->release();
        robot->frames(2);
    }
    // A line; the session works out the matte from when the button is let go.
    void draw(ImVec2 from, ImVec2 to) {
        robot->move(from);
        robot->press();
        robot->move(to);
        view.matte_busy = true;
        robot->release();
        robot->frames(2);
    }
    void have_matte() {
        ++view.history_position;
        view.matte_busy = false;
        robot->frames(2);
    }
    void expect_nothing_done() {
        EXPECT_THAT(emitted<DoEdit>(), IsEmpty());
        EXPECT_THAT(emitted<DoEdits>(), IsEmpty());
        const auto tried = emitted<TryEdits>();
        ASSERT_THAT(tried, Not(IsEmpty()));
        EXPECT_THAT(tried.back().edits, IsEmpty()) << "nothing tried stays";
    }

    Matte matte_;
};

TEST_F(TakeBack, ATransform) {
    go("Texture", Tool::kPlace);
    drag_and_escape(on(100, 80), on(130, 95));
    expect_nothing_done();
    EXPECT_EQ(shell->state().transform.drag, TransformState::Drag::kNone);
}

TEST_F(TakeBack, ACornerPin) {
    change([](Region& r) {
        r.placement.corners_px = {{{60, 40}, {120, 40}, {120, 100}, {60, 100}}};
    });
    go("Texture", Tool::kPlace);
    drag_and_escape(on(120, 100), on(150, 120));
    EXPECT_THAT(emitted<TryEdit>(), Not(IsEmpty())) << "it was dragged";
    expect_nothing_done();
}

TEST_F(TakeBack, APin) {
    go("Motion", Tool::kPin);
    drag_and_escape(on(100, 80), on(130, 95));
    EXPECT_THAT(emitted<TryEdit>(), Not(IsEmpty())) << "it was dragged";
    expect_nothing_done();
}

TEST_F(TakeBack, AShape) {
    RotoShape shape;
    for (const Vec2 at : {Vec2{100, 60}, Vec2{180, 60}, Vec2{180, 120}})
        shape.points.push_back({at, {0, 0}, {0, 0}, 0});
    view.shape = shape;
    go("Mask", Tool::kShape);
    drag_and_escape(on(180, 120), on(200, 140));
    EXPECT_THAT(emitted<SetShape>(), IsEmpty());
    EXPECT_EQ(shell->state().shape, shape);
}

TEST_F(TakeBack, ALasso) {
    go("Mask", Tool::kLasso);
    drag_and_escape(on(100, 60), on(180, 120));
    EXPECT_THAT(emitted<FillPolygon>(), IsEmpty());
    robot->stroke({on(50, 50), on(90, 50), on(90, 90)});
    EXPECT_THAT(emitted<FillPolygon>(), SizeIs(1)) << "the next one is whole";
}

TEST_F(TakeBack, ASlider) {
    go("Texture", Tool::kPan);
    const DrawnItem* scale = robot->find("Placement/Scale");
    ASSERT_NE(scale, nullptr);
    const ImVec2 at((scale->min.x + scale->max.x) / 2, (scale->min.y + scale->max.y) / 2);
    drag_and_escape(at, {at.x + 40, at.y});
    EXPECT_THAT(emitted<TryEdit>(), Not(IsEmpty())) << "it was dragged";
    expect_nothing_done();
}

TEST_F(TakeBack, AnUndoneScribbleIsNoLongerCounted) {
    go("Mask", Tool::kScribble);
    view.history_position = 4;
    draw(on(100, 60), on(120, 80));
    have_matte();
    draw(on(60, 60), on(70, 70));
    have_matte();
    ASSERT_THAT(emitted<ScribbleSelect>(), SizeIs(2));
    EXPECT_THAT(emitted<ScribbleSelect>()[1].keep, SizeIs(2));
    view.history_position = 5;
    robot->frames(2);
    EXPECT_THAT(shell->state().scribbles.lines, SizeIs(1));
    draw(on(160, 60), on(170, 70));
    EXPECT_THAT(emitted<ScribbleSelect>().back().keep, SizeIs(2));
    have_matte();
    draw(on(60, 90), on(70, 90));
    view.matte_busy = false;  // undone before the matte was there
    robot->frames(2);
    EXPECT_THAT(shell->state().scribbles.lines, SizeIs(2));
}

TEST_F(TakeBack, EscInADialogLeavesWhatIsDrawnBehindIt) {
    go("Mask", Tool::kScribble);
    draw(on(100, 60), on(120, 80));
    have_matte();
    shell->ask_to_leave();
    robot->frames(2);
    robot->key("Esc");
    robot->frames(2);
    ASSERT_FALSE(shell->state().leave_asked);
    EXPECT_THAT(shell->state().scribbles.lines, SizeIs(1));
    robot->key("Esc");
    EXPECT_THAT(shell->state().scribbles.lines, IsEmpty()) << "that one was for the lines";
    go("Mask", Tool::kPolygon);
    click_at(on(50, 50));
    click_at(on(120, 50));
    ASSERT_TRUE(robot->click("Top/Edit"));
    robot->key("Esc");
    EXPECT_THAT(shell->state().brush.outline, SizeIs(2)) << "it closed the menu";
    robot->key("Esc");
    EXPECT_THAT(shell->state().brush.outline, IsEmpty());
}

TEST_F(TakeBack, ScribblesStayOnTheirFrameUntilItsMatteIsPaintedOtherwise) {
    go("Mask", Tool::kScribble);
    view.history_position = 4;
    draw(on(100, 60), on(120, 80));
    have_matte();
    view.frame = 1004;
    robot->frames(2);
    EXPECT_THAT(shell->state().scribbles.lines, IsEmpty()) << "it is of another frame";
    view.frame = 1003;
    robot->frames(2);
    ASSERT_THAT(shell->state().scribbles.lines, SizeIs(1));
    draw(on(60, 60), on(70, 70));
    ASSERT_THAT(emitted<ScribbleSelect>(), SizeIs(2));
    EXPECT_THAT(emitted<ScribbleSelect>()[1].keep, SizeIs(2)) << "and is refined";
    have_matte();
    ++view.history_position;  // a stroke of the brush
    Leaf<Region>& region = view.project.regions[0];
    MatteSource painted = *region->matte;
    painted.keyframes[1003].path = "another.png";
    region = region.with([&](Region& r) { r.matte = painted; });
    robot->frames(2);
    EXPECT_THAT(shell->state().scribbles.lines, IsEmpty());
    view.frame = 1004;
    robot->frames(2);
    view.frame = 1003;
    robot->frames(2);
    EXPECT_THAT(shell->state().scribbles.lines, IsEmpty());
}

}  // namespace
}  // namespace weft::test
