// The tools on the canvas, and the panels that belong to them: what they emit.
#include "tests/ui/canvas_fixture.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class Tools : public CanvasTest {
  protected:
    void change(std::function<void(Region&)> what) {
        view.project.regions[0] = view.project.regions[0].with(what);
    }
};

TEST_F(Tools, ADragPinsThePlaceWhereItBelongs) {
    go("Motion", Tool::kPin);
    robot->stroke({on(100, 80), on(110, 90), on(120, 95)});
    EXPECT_FALSE(emitted<TryEdit>().empty());
    const auto set = edits<SetCorrection>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_EQ(set[0].frame, 1003);
    ASSERT_THAT(set[0].pins, SizeIs(1));
    EXPECT_NEAR(set[0].pins[0].from.x, 100, 0.6);
    EXPECT_NEAR(set[0].pins[0].to.x, 120, 0.6);
    EXPECT_NEAR(set[0].pins[0].to.y, 95, 0.6);
}

TEST_F(Tools, APinIsMovedAndAltRemovesIt) {
    change([](Region& r) { r.corrections[1003] = {{{100, 80}, {120, 95}}, {{40, 40}, {40, 40}}}; });
    go("Motion", Tool::kPin);
    robot->stroke({on(120, 95), on(130, 95)});
    auto set = edits<SetCorrection>();
    ASSERT_THAT(set, SizeIs(1));
    ASSERT_THAT(set[0].pins, SizeIs(2));
    EXPECT_NEAR(set[0].pins[0].to.x, 130, 0.6);
    EXPECT_EQ(set[0].pins[0].from.x, 100);
    clear();
    robot->hold("Alt", true);
    click_at(on(40, 40));
    robot->hold("Alt", false);
    set = edits<SetCorrection>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_THAT(set[0].pins, SizeIs(1));
}

TEST_F(Tools, TheListOfCorrectionsRemovesAFrame) {
    change([](Region& r) { r.corrections[1006] = {{{100, 80}, {120, 95}}}; });
    go("Motion", Tool::kPan);
    ASSERT_TRUE(robot->click("Unpin 1006"));
    const auto set = edits<SetCorrection>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_EQ(set[0].frame, 1006);
    EXPECT_THAT(set[0].pins, IsEmpty());
}

TEST_F(Tools, ScribblesSayWhatIsInsideAndOutside) {
    go("Mask", Tool::kScribble);
    view.matte_busy = true;  // the session works on it
    robot->stroke({on(50, 50), on(80, 60)});
    ASSERT_THAT(emitted<ScribbleSelect>(), SizeIs(1));
    EXPECT_THAT(emitted<ScribbleSelect>()[0].keep, SizeIs(1));
    clear();
    robot->hold("Alt", true);
    robot->stroke({on(150, 50), on(180, 60)});
    robot->hold("Alt", false);
    ASSERT_THAT(emitted<ScribbleSelect>(), SizeIs(1));
    EXPECT_THAT(emitted<ScribbleSelect>()[0].keep, SizeIs(1));
    EXPECT_THAT(emitted<ScribbleSelect>()[0].drop, SizeIs(1));
}

TEST_F(Tools, AShapeIsDrawnByClicksAndClosedByEnter) {
    go("Mask", Tool::kShape);
    click_at(on(50, 50));
    click_at(on(120, 50));
    robot->stroke({on(120, 120), on(100, 130)});  // a drag makes a curve
    robot->key("Enter");
    const auto set = emitted<SetShape>();
    ASSERT_THAT(set, SizeIs(1));
    ASSERT_THAT(set[0].shape.points, SizeIs(3));
    EXPECT_NEAR(set[0].shape.points[1].at.x, 120, 0.6);
    EXPECT_EQ(set[0].shape.points[0].out, Vec2(0, 0));
    EXPECT_NEAR(set[0].shape.points[2].out.x, -20, 0.6);
    EXPECT_NEAR(set[0].shape.points[2].in.x, 20, 0.6);
}

TEST_F(Tools, APointOfAShapeIsDragged) {
    RotoShape shape;
    for (const Vec2 at : {Vec2{50, 50}, Vec2{150, 50}, Vec2{100, 120}})
        shape.points.push_back({at, {0, 0}, {0, 0}, 0});
    view.shape = shape;
    go("Mask", Tool::kShape);
    robot->stroke({on(150, 50), on(160, 55), on(170, 60)});
    auto set = emitted<SetShape>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_NEAR(set[0].shape.points[1].at.x, 170, 0.6);
    EXPECT_EQ(set[0].shape.points[0].at.x, 50);
    clear();
    robot->hold("Shift", true);
    robot->stroke({on(50, 50), on(60, 50)});
    robot->hold("Shift", false);
    set = emitted<SetShape>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_NEAR(set[0].shape.points[2].at.x, 110, 0.6);
}

RotoShape box_shape() {
    RotoShape shape;
    for (const Vec2 at : {Vec2{100, 60}, Vec2{180, 60}, Vec2{180, 120}, Vec2{100, 120}})
        shape.points.push_back({at, {0, 0}, {0, 0}, 0});
    return shape;
}

TEST_F(Tools, AShapeIsMovedByADragInsideOfIt) {
    view.shape = box_shape();
    go("Mask", Tool::kShape);
    robot->stroke({on(120, 80), on(125, 85), on(140, 90)});
    const auto set = emitted<SetShape>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_NEAR(set[0].shape.points[0].at.x, 120, 0.6);
    EXPECT_NEAR(set[0].shape.points[2].at.y, 130, 0.6);
    clear();
    click_at(on(130, 80));
    robot->stroke({on(60, 80), on(70, 90)});
    EXPECT_THAT(emitted<SetShape>(), IsEmpty()) << "neither by a click nor from beside it";
}

TEST_F(Tools, AShapeIsScaledAndTurnedAboutItsPivot) {
    view.shape = box_shape();
    go("Mask", Tool::kShape);
    const DrawnItem* corner = robot->find("Handle shape scale 3");
    const DrawnItem* pivot = robot->find("Handle shape pivot");
    ASSERT_TRUE(corner && pivot);
    // Half as far from the pivot again: one and a half times as large.
    const ImVec2 away((corner->min.x - pivot->min.x) / 2, (corner->min.y - pivot->min.y) / 2);
    ASSERT_TRUE(robot->drag("Handle shape scale 3", away));
    auto set = emitted<SetShape>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_NEAR(set[0].shape.points[1].at.x - set[0].shape.points[0].at.x, 120, 3);
    EXPECT_NEAR(set[0].shape.points[2].at.y - set[0].shape.points[1].at.y, 90, 3);
    clear();
    robot->frames(2);
    const DrawnItem* knob = robot->find("Handle shape rotate");
    pivot = robot->find("Handle shape pivot");
    ASSERT_TRUE(knob && pivot);
    // From above the pivot to its right: a quarter turn.
    const float reach = pivot->min.y - knob->min.y;
    ASSERT_TRUE(robot->drag("Handle shape rotate", {reach, reach}));
    set = emitted<SetShape>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_NEAR(set[0].shape.points[0].at.x, 170, 2);
    EXPECT_NEAR(set[0].shape.points[0].at.y, 50, 2);
    clear();
    // About another pivot, which alone changes nothing.
    ASSERT_TRUE(robot->drag("Handle shape pivot", {40, 0}));
    EXPECT_THAT(emitted<SetShape>(), SizeIs(0));
}

TEST_F(Tools, WhatAShapeFollowsIsChosen) {
    view.shape = box_shape();
    view.shape_frames = {1003};
    change([](Region& r) {
        MatteSource matte;
        matte.keyframes[1003] = {"m.png", box_shape()};
        r.matte = matte;
    });
    go("Mask", Tool::kShape);
    ASSERT_TRUE(robot->click("Follow"));
    ASSERT_TRUE(robot->click("Planar"));
    ASSERT_THAT(emitted<FollowShape>(), SizeIs(1));
    EXPECT_EQ(emitted<FollowShape>()[0], FollowShape{ShapeFollow::kPlanar});
    change([](Region& r) {
        MatteSource matte;
        matte.shape = {{{1003, box_shape()}}, ShapeFollow::kPlanar, "t.json"};
        r.matte = matte;
    });
    robot->frames(2);
    ASSERT_TRUE(robot->click("Track again"));
    EXPECT_TRUE(emitted<FollowShape>().back().again);
    ASSERT_TRUE(robot->click("Follow"));
    ASSERT_TRUE(robot->click("Surface"));
    EXPECT_THAT(emitted<DetachShape>(), SizeIs(1));
}

TEST_F(Tools, ALampIsDraggedOnThePicture) {
    change([](Region& r) {
        r.light.source = LightSource::kPainted;
        r.light.lamps = *parse_lamps("point 100,80 40 1.5");
    });
    go("Seams & Light", Tool::kLamp);
    robot->stroke({on(100, 80), on(130, 90)});
    const auto set = edits<SetRegionParameter>();
    ASSERT_THAT(set, SizeIs(1));
    const auto& lamps = std::get<std::vector<Lamp>>(set[0].value);
    ASSERT_THAT(lamps, SizeIs(1));
    const std::vector<double> numbers = lamps[0].numbers.at(1003);
    EXPECT_NEAR(numbers[0], 130, 0.6);
    EXPECT_EQ(numbers[2], 40);
}

TEST_F(Tools, ALampIsAddedAndRemoved) {
    change([](Region& r) { r.light.source = LightSource::kPainted; });
    go("Seams & Light", Tool::kPan);
    ASSERT_TRUE(robot->click("+ Point"));
    auto set = edits<SetRegionParameter>();
    ASSERT_THAT(set, SizeIs(1));
    const auto lamps = std::get<std::vector<Lamp>>(set[0].value);
    EXPECT_THAT(lamps, SizeIs(1));
    change([&](Region& r) { r.light.lamps = lamps; });
    robot->frames(2);
    clear();
    ASSERT_TRUE(robot->click("Remove"));
    set = edits<SetRegionParameter>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_TRUE(std::get<std::vector<Lamp>>(set[0].value).empty());
}

TEST_F(Tools, ARectangleAsksForSimilarTextures) {
    go("Texture", Tool::kSimilar);
    robot->stroke({on(100, 60), on(180, 120)});
    EXPECT_FALSE(shell->state().drawer.similar_key.empty());
    robot->frames(2);
    ASSERT_TRUE(robot->click("Show all textures"));
    EXPECT_TRUE(shell->state().drawer.similar_key.empty());
    robot->stroke({on(100, 60), on(102, 62)});  // too small to mean anything
    EXPECT_TRUE(shell->state().drawer.similar_key.empty());
}

TEST_F(Tools, ACollectionIsMadeAndDeleted) {
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("New collection"));
    robot->type("Shot 12");
    robot->key("Enter");
    ASSERT_TRUE(settings.collections.contains("Shot 12"));
    robot->frames(2);
    ASSERT_TRUE(robot->click("Materials/Shot 12"));
    robot->frames(2);
    EXPECT_EQ(shell->state().drawer.collection, "Shot 12");
    ASSERT_TRUE(robot->click("Delete Shot 12"));
    EXPECT_TRUE(settings.collections.empty());
    EXPECT_EQ(shell->state().drawer.collection, "");
}

TEST_F(Tools, TheStripFollowsTheWorkspace) {
    go("Seams & Light", Tool::kPan);
    robot->frames();
    ASSERT_FALSE(emitted<ShowStrip>().empty());
    EXPECT_EQ(emitted<ShowStrip>().back().kind, StripKind::kKeyframes);
    view.strip.kind = StripKind::kScale;
    view.strip.cards = {{"Scale 0.50", "", 1003, nullptr, ""},
                        {"Scale 1.00", "", 1003, nullptr, "No"}};
    ASSERT_TRUE(robot->click("Strip/Scale"));
    robot->frames(2);
    clear();
    ASSERT_TRUE(robot->click("Scale 1.00"));
    ASSERT_THAT(emitted<ChooseFromStrip>(), SizeIs(1));
    EXPECT_EQ(emitted<ChooseFromStrip>()[0].card, 1);
    clear();
    ASSERT_TRUE(robot->click("Top/Mask"));
    robot->frames(2);
    ASSERT_FALSE(emitted<ShowStrip>().empty());
    EXPECT_EQ(emitted<ShowStrip>().back().kind, StripKind::kNone);
}

TEST_F(Tools, AContactSheetShowsEachSettingOnTheSameFrames) {
    go("Seams & Light", Tool::kPan);
    ASSERT_TRUE(robot->click("Strip/Scale"));
    ASSERT_TRUE(robot->click("Strip/Contact sheet"));
    robot->frames(2);
    ASSERT_FALSE(emitted<ShowStrip>().empty());
    EXPECT_EQ(emitted<ShowStrip>().back(), (ShowStrip{StripKind::kScale, {}, true}));
    view.strip = {StripKind::kScale,
                  {{"Scale 0.50", "", 1001, nullptr, ""},
                   {"Scale 0.50", "", 1010, nullptr, ""},
                   {"Scale 1.00", "", 1001, nullptr, ""},
                   {"Scale 1.00", "", 1010, nullptr, "No"}},
                  true,
                  2};
    robot->frames(2);
    clear();
    ASSERT_TRUE(robot->click("Strip/Scale 1.00"));
    ASSERT_THAT(emitted<ChooseFromStrip>(), SizeIs(1));
    EXPECT_EQ(emitted<ChooseFromStrip>()[0].card, 2);
    ASSERT_TRUE(robot->click("Scale 0.50 1010"));
    ASSERT_THAT(emitted<GoToFrame>(), SizeIs(1));
    EXPECT_EQ(emitted<GoToFrame>()[0].frame, 1010);
    // Frames of the shot know nothing of settings.
    clear();
    ASSERT_TRUE(robot->click("Strip/Keyframes"));
    robot->frames(2);
    EXPECT_EQ(emitted<ShowStrip>().back(), (ShowStrip{StripKind::kKeyframes, {}, false}));
}

TEST_F(Tools, ProvenanceIsCopied) {
    ImGui::GetIO().DisplaySize.y = 1400;  // the whole inspector
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("Source"));
    robot->frames(2);
    ASSERT_TRUE(robot->click("Copy as text"));
    EXPECT_THAT(pictures.clipboard, ::testing::HasSubstr("/textures/brick.png, seed 1"));
}

// ---- what the tools work with ----------------------------------------------------------------

TEST(RotoShapes, CoverTheirInsideAndFallOff) {
    RotoShape shape;
    for (const Vec2 at : {Vec2{20, 20}, Vec2{60, 20}, Vec2{60, 60}, Vec2{20, 60}})
        shape.points.push_back({at, {0, 0}, {0, 0}, 0});
    Matte matte = matte_of_shape(shape, {100, 100});
    EXPECT_EQ(matte.at(40, 40), 255);
    EXPECT_EQ(matte.at(70, 40), 0);
    shape.points[1].feather_px = shape.points[2].feather_px = 20;
    matte = matte_of_shape(shape, {100, 100});
    EXPECT_EQ(matte.at(40, 40), 255);
    EXPECT_GT(matte.at(65, 40), 150);
    EXPECT_GT(matte.at(65, 40), matte.at(72, 40));
    EXPECT_GT(matte.at(72, 40), 10);
    EXPECT_EQ(matte.at(84, 40), 0);
    EXPECT_EQ(matte.at(12, 40), 0);  // no feather on that side
}

TEST(RotoShapes, InterpolateAtTheMidpoint) {
    RotoShape a;
    for (int k = 0; k < 3; ++k) {
        const auto f = static_cast<float>(k);
        a.points.push_back({{10 * f, 5}, {1, f}, {2, 3}, f});
    }
    RotoShape b = a;
    b.points[1].at = {30, 25};
    EXPECT_EQ(between(a, b, 0.5f).points[1].at, Vec2(20, 15));
    b.points.pop_back();
    EXPECT_EQ(between(a, b, 0.5f), a);
}

}  // namespace
}  // namespace weft::test
