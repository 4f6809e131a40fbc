// The keys area: rows of keys and curves.
#include <algorithm>

#include "tests/ui/ui_harness.h"
#include "ui/mask/shape_box.h"
#include "ui/timeline/frame_scale.h"
#include "ui/timeline/key_parts.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class KeysArea : public PanelTest {
  protected:
    void SetUp() override {
        PanelTest::SetUp();
        change([](Region& r) {
            r.placement.scale_keys = *parse_keyed_numbers("1002:1 1006:3:smooth 1008:2");
            r.light.strength_keys = *parse_keyed_numbers("1002:0.5 1006:1");
        });
        robot->frames(2);
        robot->key("Ctrl+Shift+K");
        robot->frames(3);
        clear();
    }
    template <class Change>
    void change(Change&& to) {
        view.project.regions[0] = view.project.regions[0].with(to);
    }
    [[nodiscard]] const Region& region() const { return *view.project.regions[0]; }
    [[nodiscard]] ImVec2 middle(const std::string& item) const {
        const DrawnItem* found = robot->find(item);
        EXPECT_NE(found, nullptr) << item;
        if (!found) return {0, 0};
        return {(found->min.x + found->max.x) / 2, (found->min.y + found->max.y) / 2};
    }
    // How far a frame is on the screen.
    [[nodiscard]] float frame_px() const {
        return (middle("Texture scale 1006").x - middle("Texture scale 1002").x) / 4;
    }
    void press_with(const char* modifier, const std::string& item) {
        robot->hold(modifier, true);
        robot->click(item);
        robot->hold(modifier, false);
    }
    // Applies what was emitted, as the session does.
    void apply() {
        for (const DoEdits& done : emitted<DoEdits>())
            view.project = apply_edits(view.project, done.edits).value();
        clear();
        robot->frames(2);
    }
    [[nodiscard]] std::string scale() const { return keyed_text(region().placement.scale_keys); }
};

TEST_F(KeysArea, HasARowForWhatIsKeyedOnly) {
    for (const char* there : {"Keys/Matte 1003", "Texture scale 1002", "Light strength 1006"})
        EXPECT_NE(robot->find(there), nullptr) << there;
    EXPECT_EQ(robot->find("Texture rotation 1002"), nullptr);
    // The same frame is at the same place in every row and under the ruler.
    EXPECT_NEAR(middle("Texture scale 1006").x, middle("Light strength 1006").x, 0.5f);
    robot->key("Ctrl+Shift+K");
    robot->frames(2);
    EXPECT_EQ(robot->find("Texture scale 1002"), nullptr);
}

TEST_F(KeysArea, ADragMovesWholeFramesAndIsOneStep) {
    ASSERT_TRUE(robot->drag("Texture scale 1002", {2.2f * frame_px(), 0}));
    const auto done = emitted<DoEdits>();
    ASSERT_THAT(done, SizeIs(1));
    EXPECT_EQ(done[0].label, "Move keys");
    EXPECT_THAT(emitted<TryEdits>(), ::testing::Not(IsEmpty())) << "shown while it is dragged";
    apply();
    EXPECT_EQ(scale(), "1004:1 1006:3:smooth 1008:2");
}

TEST_F(KeysArea, SeveralKeysMoveTogetherAndStayInTheShot) {
    robot->click("Texture scale 1006");
    press_with("Shift", "Light strength 1006");
    press_with("Shift", "Texture scale 1008");
    ASSERT_TRUE(robot->drag("Texture scale 1008", {9 * frame_px(), 0}));
    apply();
    EXPECT_EQ(scale(), "1002:1 1008:3:smooth 1010:2") << "the shot ends with 1010";
    EXPECT_EQ(keyed_text(region().light.strength_keys), "1002:0.5 1008:1");
}

TEST_F(KeysArea, EscapeTakesADragBack) {
    robot->move(middle("Texture scale 1002"));
    robot->press();
    robot->move({middle("Texture scale 1002").x + 3 * frame_px(), middle("Texture scale 1002").y});
    robot->frames(2);
    robot->key("Esc");
    robot->release();
    robot->frames(2);
    EXPECT_THAT(emitted<DoEdits>(), IsEmpty());
    const auto tried = emitted<TryEdits>();
    ASSERT_FALSE(tried.empty());
    EXPECT_THAT(tried.back().edits, IsEmpty());
}

TEST_F(KeysArea, ABoxSelectsAndDeleteRemoves) {
    const ImVec2 a = middle("Texture scale 1006"), b = middle("Light strength 1006");
    const float x = frame_px();
    robot->move({a.x - x, std::min(a.y, b.y) - 8});
    robot->press();
    robot->move({a.x + x, std::max(a.y, b.y) + 8});
    robot->frames(2);
    robot->release();
    robot->frames(2);
    EXPECT_THAT(shell->state().keys.selected, SizeIs(2));
    robot->key("Delete");
    apply();
    EXPECT_EQ(scale(), "1002:1 1008:2");
    EXPECT_EQ(keyed_text(region().light.strength_keys), "1002:0.5");
    EXPECT_THAT(shell->state().keys.selected, IsEmpty());
    EXPECT_THAT(emitted<ClearMatte>(), IsEmpty());
}

TEST_F(KeysArea, CopiedKeysArePastedAtThePlayhead) {
    robot->click("Texture scale 1006");
    press_with("Shift", "Light strength 1006");
    robot->key("Ctrl+C");
    robot->frames(1);
    view.frame = 1009;
    robot->frames(2);
    robot->key("Ctrl+V");
    apply();
    EXPECT_EQ(scale(), "1002:1 1006:3:smooth 1008:2 1009:3:smooth");
    EXPECT_EQ(keyed_text(region().light.strength_keys), "1002:0.5 1006:1 1009:1");
}

TEST_F(KeysArea, ShortcutsBelongToItOnlyAfterAPressThere) {
    robot->click("Texture scale 1006");
    ASSERT_TRUE(shell->state().keys.focused);
    robot->click("Viewer/Canvas");
    clear();
    robot->key("Delete");
    EXPECT_THAT(emitted<DoEdits>(), IsEmpty());
    EXPECT_THAT(emitted<ClearMatte>(), SizeIs(1));
}

TEST_F(KeysArea, InterpolationIsSetByButtonsAndTheMenu) {
    robot->click("Texture scale 1002");
    ASSERT_TRUE(robot->click("Keys/Hold"));
    apply();
    EXPECT_EQ(scale(), "1002:1:hold 1006:3:smooth 1008:2");
    robot->move(middle("Texture scale 1006"));
    robot->press(1);
    robot->release(1);
    robot->frames(3);
    ASSERT_TRUE(robot->click("Key menu/Linear"));
    apply();
    EXPECT_EQ(scale(), "1002:1:hold 1006:3 1008:2");
}

TEST_F(KeysArea, ButtonsGoToThePreviousAndNextKey) {
    ASSERT_TRUE(robot->click("Next key"));
    ASSERT_THAT(emitted<GoToFrame>(), SizeIs(1));
    EXPECT_EQ(emitted<GoToFrame>()[0].frame, 1006);
    ASSERT_TRUE(robot->click("Previous key"));
    EXPECT_EQ(emitted<GoToFrame>()[1].frame, 1002);
}

TEST_F(KeysArea, FrameAndValueAreTyped) {
    robot->click("Texture scale 1006");
    robot->frames(2);
    ASSERT_TRUE(robot->click("Keys/Value"));
    robot->key("Ctrl+A");
    robot->type("1.25");
    robot->key("Enter");
    apply();
    EXPECT_EQ(scale(), "1002:1 1006:1.25:smooth 1008:2");
    ASSERT_TRUE(robot->click("Keys/Frame"));
    robot->key("Ctrl+A");
    robot->type("1005");
    robot->key("Enter");
    apply();
    EXPECT_EQ(scale(), "1002:1 1005:1.25:smooth 1008:2");
}

class Curves : public KeysArea {
  protected:
    void SetUp() override {
        KeysArea::SetUp();
        robot->click("Keys/Curves");
        robot->frames(3);
        clear();
    }
};

TEST_F(Curves, AKeyIsDraggedInFrameAndValue) {
    // Lower is less: between the keys of 1 and 3 the curve falls by so much a pixel.
    const float per_px = 2 / (middle("Texture scale 1002").y - middle("Texture scale 1006").y);
    ASSERT_GT(per_px, 0);
    ASSERT_TRUE(robot->drag("Texture scale 1002", {frame_px(), -20}));
    ASSERT_THAT(emitted<DoEdits>(), SizeIs(1));
    apply();
    const auto& keys = region().placement.scale_keys;
    ASSERT_TRUE(keys.has(1003));
    EXPECT_NEAR(keys.at(1003)[0], 1 + 20 * per_px, 0.15);
    EXPECT_EQ(keyed_text(region().light.strength_keys), "1002:0.5 1006:1");
}

TEST_F(Curves, ValuesStayInTheirRange) {
    ASSERT_TRUE(robot->drag("Light strength 1006", {0, -2000}));
    apply();
    EXPECT_EQ(region().light.strength_keys.at(1006)[0], 2);
}

TEST_F(Curves, TheWheelZoomsAndFFits) {
    const float before = frame_px();
    robot->move(middle("Plot"));
    robot->wheel(3);
    robot->frames(2);
    EXPECT_GT(frame_px(), 1.2f * before);
    EXPECT_TRUE(shell->state().keys.frames);
    robot->click("Texture scale 1006");
    robot->key("F");
    robot->frames(2);
    EXPECT_NEAR(frame_px(), before, 0.5f);
    EXPECT_FALSE(shell->state().viewer.fit && shell->state().keys.frames);
}

TEST_F(Curves, OneCurveAloneIsShownByAClickOnItsName) {
    ASSERT_TRUE(robot->click("Curve Light strength"));
    robot->frames(2);
    EXPECT_EQ(robot->find("Texture scale 1006"), nullptr);
    EXPECT_NE(robot->find("Light strength 1006"), nullptr);
    ASSERT_TRUE(robot->click("Curve Light strength"));
    robot->frames(2);
    EXPECT_NE(robot->find("Texture scale 1006"), nullptr);
}

TEST(KeyCurves, HaveANameForEachNumber) {
    Region region;
    region.placement.offset_keys = *parse_keyed_numbers("1:0,0 9:1,2", 2);
    const auto curves = ui::key_curves(region, key_rows(region));
    ASSERT_THAT(curves, SizeIs(2));
    EXPECT_EQ(curves[1].name, "Texture offset y");
    EXPECT_EQ(ui::row_name({KeyRowKind::kZoneValue, 1}), "Zone 2 value");
    EXPECT_EQ(ui::row_name({KeyRowKind::kMatte, -1}), "Zone 1 matte");
}

TEST(FrameScale, IsLinearBothWays) {
    const ui::FrameScale scale{100, 300, 11, 21};
    EXPECT_FLOAT_EQ(scale.x_of(16), 200);
    EXPECT_DOUBLE_EQ(scale.at(200), 16);
    EXPECT_FLOAT_EQ(scale.frame_width(), 20);
}

TEST(ShapeBox, TurnsAndScalesAboutAPivot) {
    RotoShape shape;
    shape.points = {{{10, 0}, {0, 0}, {2, 0}, 3}, {{0, 10}}, {{0, 0}}};
    const RotoShape turned = ui::turned_shape(shape, {0, 0}, 2, 1.5707963f);
    EXPECT_NEAR(turned.points[0].at.x, 0, 1e-4);
    EXPECT_NEAR(turned.points[0].at.y, 20, 1e-4);
    EXPECT_NEAR(turned.points[0].out.y, 4, 1e-4);
    EXPECT_FLOAT_EQ(turned.points[0].feather_px, 6);
    const auto box = ui::box_of_shape(shape, 1);
    EXPECT_LE(box[0].x, -1);
    EXPECT_GE(box[2].y, 11);
}

TEST(ShapeBox, TurnsTheUnsqueezedPicture) {
    RotoShape shape;
    shape.points = {{{10, 0}, {0, 0}, {2, 0}, 3}, {{0, 10}}, {{0, 0}}};
    const PixelAspect aspect(2);
    const RotoShape turned = ui::turned_shape(shape, {0, 0}, 1, 1.5707963f, aspect);
    EXPECT_NEAR(turned.points[0].at.x, 0, 1e-4);
    EXPECT_NEAR(turned.points[0].at.y, 20, 1e-4);
    EXPECT_NEAR(turned.points[1].at.x, -5, 1e-4);
    EXPECT_NEAR(turned.points[0].out.y, 4, 1e-4);
    const auto box = ui::box_of_shape(shape, 4, aspect);
    EXPECT_NEAR(box[0].x, -2, 0.1);
    EXPECT_LE(box[0].y, -4);
}

}  // namespace
}  // namespace weft::test
