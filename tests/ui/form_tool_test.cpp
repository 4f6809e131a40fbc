// Drawing the form of a surface: what the tool and the Form section emit.
#include "tests/ui/canvas_fixture.h"
#include "ui/form/drawing.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

FormGuide guide(FormGuideKind kind, std::vector<double> numbers) {
    return {kind, std::move(numbers)};
}

class FormTool : public CanvasTest {
  protected:
    void change(const std::function<void(Region&)>& what) {
        view.project.regions[0] = view.project.regions[0].with(what);
        robot->frames(2);
    }
    void draw(const char* kind, ImVec2 from, ImVec2 to) {
        ASSERT_TRUE(robot->click(std::string("Form/") + kind));
        robot->stroke({from, {(from.x + to.x) / 2, (from.y + to.y) / 2}, to});
        robot->frames(2);
    }
    // Carries out what was emitted, as the session does.
    void take() {
        for (const DoEdits& one : emitted<DoEdits>()) {
            auto changed = apply_edits(view.project, one.edits);
            ASSERT_TRUE(changed) << changed.error().text();
            view.project = std::move(*changed);
        }
        clear();
        robot->frames(2);
    }
    const FormParams& form() const { return view.project.regions[0]->form; }
};

TEST_F(FormTool, ADragDrawsABallAsOneStep) {
    go("Texture", Tool::kPan);
    draw("Ball", on(100, 80), on(140, 80));
    EXPECT_THAT(emitted<TryEdit>(), IsEmpty());
    ASSERT_THAT(emitted<DoEdits>(), SizeIs(1));
    take();
    ASSERT_THAT(form().shape, SizeIs(1));
    EXPECT_EQ(form().shape[0].kind, FormGuideKind::kBall);
    EXPECT_NEAR(form().shape[0].numbers[0], 100, 0.6);
    EXPECT_NEAR(form().shape[0].numbers[2], 40, 0.6);
}

TEST_F(FormTool, AClickDrawsNothing) {
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("Form/Plane"));
    click_at(on(100, 80));
    EXPECT_THAT(emitted<DoEdits>(), IsEmpty());
}

TEST_F(FormTool, AHandleCorrectsTheShape) {
    change([](Region& r) { r.form.shape = {guide(FormGuideKind::kBall, {100, 80, 40})}; });
    go("Texture", Tool::kForm);
    robot->stroke({on(140, 80), on(145, 80), on(150, 80)});
    take();
    EXPECT_NEAR(form().shape[0].numbers[2], 50, 0.6);
    robot->stroke({on(100, 80), on(105, 85), on(110, 90)});
    take();
    EXPECT_NEAR(form().shape[0].numbers[1], 90, 0.6);
    EXPECT_NEAR(form().shape[0].numbers[2], 50, 0.6);
}

TEST_F(FormTool, SaysOnAShapeWhyItCannotBeUsed) {
    change([](Region& r) { r.form.shape = {guide(FormGuideKind::kBall, {100, 80, 40})}; });
    go("Texture", Tool::kForm);
    EXPECT_EQ(robot->find("Form problem"), nullptr);
    view.form_problems[view.selected] = "The shape does not lie on the region.";
    robot->frames(2);
    const DrawnItem* said = robot->find("Form problem");
    ASSERT_NE(said, nullptr);
    const ImVec2 centre = on(100, 80);
    EXPECT_LT(std::hypot(said->min.x - centre.x, said->min.y - centre.y), 300);
}

TEST_F(FormTool, CtrlRemovesAShapeAndTheSourceIsAutomaticAgain) {
    change([](Region& r) {
        r.form.shape = {guide(FormGuideKind::kBall, {100, 80, 40})};
        r.form.source = FormSource::kShape;
    });
    go("Texture", Tool::kForm);
    robot->hold("Ctrl", true);
    click_at(on(100, 80));
    robot->hold("Ctrl", false);
    take();
    EXPECT_THAT(form().shape, IsEmpty());
    EXPECT_EQ(form().source, FormSource::kAuto);
}

TEST_F(FormTool, TwoParallelStrokesShowAPlaneAndReplaceTheShape) {
    change([](Region& r) {
        r.form.shape = {guide(FormGuideKind::kBall, {250, 140, 20})};
        r.form.source = FormSource::kFlat;
    });
    go("Texture", Tool::kPan);
    draw("Parallel", on(40, 40), on(140, 40));
    EXPECT_THAT(emitted<DoEdits>(), IsEmpty());
    draw("Parallel", on(40, 90), on(140, 95));
    take();
    EXPECT_THAT(form().shape, IsEmpty());
    ASSERT_THAT(form().strokes, SizeIs(1));
    EXPECT_THAT(form().strokes[0].numbers, SizeIs(8));
    EXPECT_EQ(form().source, FormSource::kShape);
}

TEST_F(FormTool, ShapesAreDrawnOnTheReferenceFrame) {
    view.preview.references[1] = 1001;
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("Form/Ball"));
    ASSERT_THAT(emitted<GoToFrame>(), SizeIs(1));
    EXPECT_EQ(emitted<GoToFrame>()[0].frame, 1001);
    robot->stroke({on(100, 80), on(120, 80), on(140, 80)});
    EXPECT_THAT(emitted<DoEdits>(), IsEmpty());
    EXPECT_TRUE(robot->click("Go to reference frame 1001"));
}

TEST_F(FormTool, TheTiltOfACylinderCanBeSet) {
    change([](Region& r) {
        r.form.shape = {guide(FormGuideKind::kCylinder, {100, 40, 100, 120, 30, 30})};
    });
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("Tilt from outline"));
    const auto set = edits<SetRegionParameter>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_THAT(std::get<std::vector<FormGuide>>(set[0].value)[0].numbers, SizeIs(7));
}

TEST_F(FormTool, TheCheckerIsShownFromTheSection) {
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("Form/Checker"));
    ASSERT_THAT(emitted<ShowOverlay>(), SizeIs(1));
    EXPECT_EQ(emitted<ShowOverlay>()[0].overlay, Overlay::kChecker);
}

TEST_F(FormTool, NormalsAreShownFromTheSection) {
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("Form/Normals"));
    ASSERT_THAT(emitted<ShowOverlay>(), SizeIs(1));
    EXPECT_EQ(emitted<ShowOverlay>()[0].overlay, Overlay::kNormals);
}

TEST_F(FormTool, ACutIsAStrokeBesideTheOthers) {
    change([](Region& r) {
        r.form.strokes = {guide(FormGuideKind::kLevel, {40, 40, 140, 40})};
        r.form.source = FormSource::kInflate;
    });
    go("Texture", Tool::kPan);
    draw("Cut", on(40, 90), on(140, 95));
    take();
    ASSERT_THAT(form().strokes, SizeIs(2));
    EXPECT_EQ(form().strokes[1].kind, FormGuideKind::kCut);
    EXPECT_EQ(form().source, FormSource::kInflate);
}

// ---- the geometry ----------------------------------------------------------------------------

TEST(FormDrawing, ACylinderIsAsWideAsTheMatte) {
    Matte matte(200, 200);
    for (int y = 20; y < 180; ++y)
        for (int x = 70; x < 130; ++x)
            matte.at(x, y) = 255;
    const auto drawn = ui::guide_of_drag(FormGuideKind::kCylinder, {100, 40}, {100, 160}, matte);
    ASSERT_TRUE(drawn);
    EXPECT_NEAR(drawn->numbers[4], 30, 1);
    EXPECT_NEAR(drawn->numbers[5], 30, 1);
    const auto beside = ui::guide_of_drag(FormGuideKind::kCylinder, {20, 40}, {20, 160}, matte);
    ASSERT_TRUE(beside);
    EXPECT_NEAR(beside->numbers[4], 30, 1);  // a quarter of its length
}

TEST(FormDrawing, APlaneHasItsCornersInOrderWhicheverWayItIsDragged) {
    const auto drawn = ui::guide_of_drag(FormGuideKind::kPlane, {90, 80}, {10, 20}, {});
    ASSERT_TRUE(drawn);
    EXPECT_THAT(drawn->numbers, ElementsAre(10, 20, 90, 20, 90, 80, 10, 80));
    EXPECT_FALSE(ui::guide_of_drag(FormGuideKind::kPlane, {90, 80}, {90, 20}, {}));
}

TEST(FormDrawing, EveryHandleGoesWhereItIsDragged) {
    for (const FormGuide& one :
         {guide(FormGuideKind::kPlane, {10, 10, 90, 12, 95, 80, 5, 78}),
          guide(FormGuideKind::kCylinder, {50, 10, 50, 90, 20, 25, 5}),
          guide(FormGuideKind::kBall, {50, 50, 20}), guide(FormGuideKind::kLevel, {1, 2, 3, 4})}) {
        const auto handles = ui::handles_of(one);
        for (std::size_t k = 0; k < handles.size(); ++k) {
            // Widths are dragged across, the ball's along x.
            const Vec2 to = handles[k].at + (handles[k].filled ? Vec2(3, 4) : Vec2(3, 0));
            const Vec2 now = ui::handles_of(ui::with_handle_at(one, k, to))[k].at;
            const float off = std::hypot(now.x - to.x, now.y - to.y);
            EXPECT_LT(off, 1e-3f) << info_of(one.kind).name << " " << handles[k].name;
        }
    }
}

TEST(FormDrawing, ParallelStrokesAcrossTheFirstBeginASecondGroup) {
    std::vector<FormGuide> strokes{guide(FormGuideKind::kLevel, {0, 0, 9, 0})};
    const auto add = [&](std::vector<double> line) {
        ui::add_parallel(guide(FormGuideKind::kParallel, std::move(line)), strokes);
    };
    add({0, 0, 100, 0});
    add({0, 50, 100, 60});
    add({10, 0, 10, 80});
    add({90, 80, 92, 0});
    ASSERT_THAT(strokes, SizeIs(3));
    EXPECT_THAT(strokes[1].numbers, SizeIs(8));
    EXPECT_THAT(strokes[2].numbers, SizeIs(8));
    ui::remove_line(2, 0, strokes);
    EXPECT_THAT(strokes[2].numbers, ElementsAre(90, 80, 92, 0));
    ui::remove_line(2, 0, strokes);
    EXPECT_THAT(strokes, SizeIs(2));
}

TEST(FormDrawing, TheSourceBecomesTheShapeOnlyWhereAnotherWouldBeRead) {
    Region region;
    region.id = 1;
    const std::vector<FormGuide> ball{guide(FormGuideKind::kBall, {50, 50, 20})};
    EXPECT_THAT(ui::edits_of_form(region, ball, {}), SizeIs(1));
    region.form.position = "P.####.exr";
    EXPECT_THAT(ui::edits_of_form(region, ball, {}), SizeIs(2));
    const std::vector<FormGuide> level{guide(FormGuideKind::kLevel, {0, 0, 9, 0})};
    EXPECT_THAT(ui::edits_of_form(region, {}, level), SizeIs(1));
}

// A ball is round, and a cylinder as wide across as it looks, on the picture unsqueezed.
TEST(FormDrawing, IsThatOfTheUnsqueezedPicture) {
    const PixelAspect aspect(2);
    const auto ball =
        ui::guide_of_drag(FormGuideKind::kBall, {50, 50}, {60, 50}, Matte(100, 100), aspect);
    ASSERT_TRUE(ball);
    EXPECT_THAT(ball->numbers, ::testing::ElementsAre(50, 50, 20));
    const auto lines = ui::lines_of(*ball, aspect);
    for (const Vec2 place : lines[0]) {
        const Vec2 way = aspect.unsqueezed(place - Vec2(50, 50));
        EXPECT_NEAR(std::hypot(way.x, way.y), 20, 1e-3);
    }
    const auto handles = ui::handles_of(*ball, aspect);
    EXPECT_NEAR(handles[1].at.x, 60, 1e-4);
    EXPECT_NEAR(ui::with_handle_at(*ball, 1, {50, 80}, aspect).numbers[2], 30, 1e-4);
    const auto moved = ui::with_handle_at(*ball, 0, {70, 40}, aspect);
    EXPECT_THAT(moved.numbers, ::testing::ElementsAre(70, 40, 20));
    Matte band(100, 100);
    for (int y = 10; y < 90; ++y)
        for (int x = 40; x < 60; ++x)
            band.at(x, y) = 255;
    const auto column =
        ui::guide_of_drag(FormGuideKind::kCylinder, {50, 15}, {50, 85}, band, aspect);
    ASSERT_TRUE(column);
    EXPECT_NEAR(column->numbers[4], 20, 2) << "ten pixels of the plate";
    EXPECT_NEAR(ui::handles_of(*column, aspect)[2].at.x, 40, 1.1);
}

}  // namespace
}  // namespace weft::test
