// Painted holdouts, and the direction of matte propagation.
#include "app/mattes/matte_layer.h"
#include "engine/media/image_files.h"
#include "tests/ui/ui_harness.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class PaintedLayers : public SessionTest {
  protected:
    void open() {
        session->act(OpenAny{(folder / "frames").string()});
        ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
        robot->frames(3);
        robot->key("Ctrl+Shift+N");
        robot->key("B");
        robot->frames(3);
        robot->stroke({at(20, 30), at(50, 32), at(80, 34)});
        robot->frames(3);
    }
    [[nodiscard]] const Region& region() const { return *session->view().project.regions.back(); }
    // Of the inspector, over which the mouse is.
    void to_the_end() {
        ASSERT_TRUE(robot->hover("Light zones"));
        robot->wheel(-30);
        robot->frames(3);
    }
    void paint_holdout() {
        ASSERT_TRUE(robot->click("Holdouts"));
        robot->wheel(-30);
        robot->frames(3);
        ASSERT_TRUE(robot->click("Holdouts/Paint a holdout"));
        robot->frames(3);
        EXPECT_EQ(session->view().matte_layer, 1);
        EXPECT_THAT(*region().holdouts, IsEmpty());
        robot->stroke({at(50, 20), at(50, 44)});
        robot->frames(3);
    }
};

TEST_F(PaintedLayers, AHoldoutIsPaintedLikeAMatteAndCutOutOfTheResult) {
    open();
    const MatteSource before = *region().matte;
    paint_holdout();
    ASSERT_THAT(*region().holdouts, SizeIs(1));
    EXPECT_EQ(*region().matte, before) << "the region's own matte stays";
    const MatteSource holdout = region().holdouts->front();
    ASSERT_TRUE(holdout.keyframes.contains(1));
    session->flush();
    const auto written = read_matte(holdout.keyframes.at(1).path, {}, {96, 64});
    ASSERT_TRUE(written) << written.error().text();
    EXPECT_GT(written->at(50, 30), 200);
    EXPECT_EQ(written->at(20, 30), 0);

    // It is propagated to the other frames and cut out of the texture there.
    session->act(SetPreviewQuality{Quality::kDraft});
    session->act(ApplyTexture{(folder / "tile.png").string(), region().id});
    session->act(GoToFrame{3});
    ASSERT_TRUE(wait([&] {
        const auto& h = session->view().holdouts;
        return session->view().result_current && h.size() == 1 && h[0].keep;
    })) << session->view().preview.error;
    const SessionView& v = session->view();
    EXPECT_EQ(v.holdouts[0].kind, RegionMatteView::Kind::kPropagated);
    int covered = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 96; ++x)
            covered += v.holdouts[0].pixels.at(x, y) > 127 ? 1 : 0;
    EXPECT_GT(covered, 50);

    // Undo removes the layer.
    for (int k = 0; k < 2; ++k) {
        robot->key("Ctrl+Z");
        robot->frames(2);
    }
    EXPECT_THAT(*region().holdouts, IsEmpty());
}

TEST_F(PaintedLayers, KeysOfALayerAreSetAndRemovedThere) {
    open();
    paint_holdout();
    ASSERT_THAT(*region().holdouts, SizeIs(1));
    session->act(GoToFrame{2});
    settings.here_only = false;
    // A stroke on a frame to which the layer was not propagated yet is refused.
    ASSERT_TRUE(wait([&] {
        const auto& h = session->view().holdouts;
        return h.size() == 1 && h[0].frame == 2 &&
               h[0].kind == RegionMatteView::Kind::kPropagated && h[0].keep;
    }));
    robot->frames(2);
    robot->stroke({at(52, 20), at(52, 44)});
    robot->frames(3);
    ASSERT_THAT(region().holdouts->front().keyframes, SizeIs(2));
    EXPECT_TRUE(session->view().marks[1].matte_key);
    ASSERT_TRUE(robot->click("Matte/Remove keyframe"));
    robot->frames(2);
    EXPECT_THAT(region().holdouts->front().keyframes, SizeIs(1));
    EXPECT_THAT(region().matte->keyframes, SizeIs(1));
    ASSERT_TRUE(robot->click("Holdouts/Remove layer 1"));
    robot->frames(2);
    EXPECT_THAT(*region().holdouts, IsEmpty());
    EXPECT_EQ(session->view().matte_layer, 0);
}

TEST_F(PaintedLayers, AnEdgeIsConfirmedAndCorrectedOnAPropagatedFrame) {
    open();
    session->act(GoToFrame{3});
    ASSERT_TRUE(wait([&] {
        const auto& m = session->view().mattes;
        return session->view().frame == 3 && m.size() == 1 && m[0].keep;
    }));
    robot->key("Shift+E");
    robot->frames(2);
    EXPECT_EQ(shell->state().tool, Tool::kConfirm);
    robot->stroke({at(20, 20), at(40, 22)});
    robot->frames(3);
    ASSERT_TRUE(region().matte->confirmed.contains(3));
    EXPECT_THAT(region().matte->keyframes, SizeIs(1));
    EXPECT_TRUE(session->view().marks[2].confirmed);
    ASSERT_TRUE(robot->click("Matte/Remove confirmed"));
    robot->frames(3);
    EXPECT_THAT(region().matte->confirmed, IsEmpty());

    robot->key("B");
    robot->frames(2);
    robot->stroke({at(50, 50), at(60, 50)});
    robot->frames(3);
    EXPECT_TRUE(region().matte->confirmed.contains(3));
    EXPECT_THAT(region().matte->keyframes, SizeIs(1));
    ASSERT_TRUE(robot->click("Brush/Correct only where painted"));
    robot->frames(2);
    robot->stroke({at(50, 50), at(60, 50)});
    robot->frames(3);
    EXPECT_THAT(region().matte->keyframes, SizeIs(2)) << "the whole frame";
    EXPECT_THAT(region().matte->confirmed, IsEmpty());
}

TEST_F(PaintedLayers, DirectionAndRangeAreChosenInTheInspector) {
    open();
    ASSERT_TRUE(robot->click("Propagation/Forwards"));
    robot->frames(2);
    EXPECT_EQ(region().matte->propagate_direction, PropagationDirection::kForward);
    session->act(MarkRange{2, 3});
    robot->frames(2);
    ASSERT_TRUE(robot->click("Propagation/Marked range"));
    robot->frames(2);
    EXPECT_EQ(region().matte->propagate_from, 2);
    EXPECT_EQ(region().matte->propagate_to, 3);
    ASSERT_TRUE(robot->click("Propagation/Whole shot"));
    robot->frames(2);
    EXPECT_FALSE(region().matte->propagate_from || region().matte->propagate_to);
    robot->key("Ctrl+Z");
    robot->frames(2);
    EXPECT_EQ(region().matte->propagate_to, 3);
}

TEST_F(PaintedLayers, ALightZoneIsPaintedAndItsValueChanges) {
    open();
    ASSERT_TRUE(robot->click("Light zones"));
    robot->wheel(-30);
    robot->frames(3);
    ASSERT_TRUE(robot->click("Light zones/Paint a light zone"));
    robot->frames(3);
    EXPECT_EQ(session->view().matte_layer, zone_layer(0));
    robot->stroke({at(40, 25), at(60, 40)});
    robot->frames(3);
    ASSERT_THAT(*region().zones, SizeIs(1));
    EXPECT_THAT(*region().holdouts, IsEmpty());
    EXPECT_EQ(region().zones->front().value, 0.0);
    EXPECT_TRUE(region().zones->front().matte.keyframes.contains(1));
    EXPECT_THAT(session->view().zones, SizeIs(1));
    to_the_end();
    ASSERT_TRUE(robot->click("Light zones/Back to the matte"));
    robot->frames(2);
    to_the_end();
    EXPECT_EQ(session->view().matte_layer, 0);
    ASSERT_TRUE(robot->drag("Light zones/Light", {20, 0}));
    robot->frames(3);
    EXPECT_GT(region().zones->front().value, 0.0);
    ASSERT_TRUE(robot->click("Light zones/Remove zone 1"));
    robot->frames(2);
    EXPECT_THAT(*region().zones, IsEmpty());
}

TEST_F(PaintedLayers, WhatIsLightAndWhatIsPaintIsPainted) {
    open();
    ASSERT_TRUE(robot->click("Light zones"));
    robot->wheel(-30);
    robot->frames(3);
    ASSERT_TRUE(robot->click("Light zones/Paint: this is light"));
    robot->frames(3);
    robot->stroke({at(40, 25), at(60, 40)});
    robot->frames(3);
    ASSERT_THAT(*region().zones, SizeIs(1));
    EXPECT_EQ(region().zones->front().kind, ZoneKind::kDetail);
    EXPECT_EQ(region().zones->front().value, 1.0);
    to_the_end();
    ASSERT_TRUE(robot->click("Light zones/Back to the matte"));
    robot->frames(2);
    to_the_end();
    ASSERT_TRUE(robot->click("Light zones/Paint: this is paint"));
    robot->frames(3);
    robot->stroke({at(20, 25), at(30, 40)});
    robot->frames(3);
    ASSERT_THAT(*region().zones, SizeIs(2));
    EXPECT_EQ(region().zones->back().kind, ZoneKind::kDetail);
    EXPECT_EQ(region().zones->back().value, 0.0);
}

TEST_F(PaintedLayers, MotionZonesArePaintedInTheMotionWorkspace) {
    open();
    shell->state().workspace = Workspace::kMotion;
    robot->frames(3);
    ASSERT_TRUE(robot->click("Motion zones"));
    robot->wheel(-30);
    robot->frames(3);
    EXPECT_EQ(robot->find("Tools/Eraser"), nullptr);
    ASSERT_TRUE(robot->click("Motion zones/Paint: stiffer"));
    robot->frames(3);
    EXPECT_NE(robot->find("Tools/Eraser"), nullptr) << "while a zone is painted";
    EXPECT_EQ(session->view().matte_layer, zone_layer(0));
    robot->stroke({at(40, 25), at(60, 40)});
    robot->frames(3);
    ASSERT_THAT(*region().zones, SizeIs(1));
    EXPECT_EQ(region().zones->front().kind, ZoneKind::kStiffer);
    EXPECT_EQ(region().zones->front().value, 1.0);
    ASSERT_TRUE(robot->drag("Motion zones/Stiffer", {-40, 0}));
    robot->frames(3);
    EXPECT_LT(region().zones->front().value, 1.0);
    // It belongs to the motion only.
    shell->state().workspace = Workspace::kMask;
    robot->frames(3);
    EXPECT_EQ(robot->find("Light zones/Light"), nullptr);
}

TEST(MatteLayer, ZonesHaveNumbersBelowZero) {
    Region region;
    region.id = 4;
    MatteSource painted;
    painted.keyframes[7] = {"a.png", {}};
    EXPECT_EQ(first_layer(region), -1);
    EXPECT_EQ(last_layer(region), 1);
    const Edit begun = set_layer(region, -1, painted);
    ASSERT_TRUE(std::holds_alternative<SetZones>(begun));
    region.zones = std::get<SetZones>(begun).zones;
    EXPECT_EQ(layer_source(region, -1), painted);
    EXPECT_TRUE(layer_source(region, -2).empty());
    EXPECT_EQ(first_layer(region), -2);
    EXPECT_THAT(std::get<SetZones>(without_layer_key(region, -1, 7)).zones, IsEmpty());
}

TEST(MatteLayer, TheLastKeyOfAHoldoutTakesItWithIt) {
    Region region;
    region.id = 4;
    MatteSource painted;
    painted.keyframes[7] = {"a.png", {}};
    MatteSource files;
    files.files = "h/####.png";
    region.holdouts = std::vector<MatteSource>{files, painted};
    const Edit edit = without_layer_key(region, 2, 7);
    ASSERT_TRUE(std::holds_alternative<SetHoldouts>(edit));
    EXPECT_EQ(std::get<SetHoldouts>(edit).holdouts, (std::vector<MatteSource>{files}));
    EXPECT_EQ(layer_source(region, 2), painted);
    EXPECT_TRUE(layer_source(region, 3).empty());
    EXPECT_EQ(std::get<SetHoldouts>(set_layer(region, 3, painted)).holdouts.size(), 3u);
}

TEST_F(PaintedLayers, EdgeToolsChangeTheMatteThatIsEdited) {
    open();
    ASSERT_TRUE(robot->drag("Edge/Choke", {20, 0}));
    robot->frames(3);
    EXPECT_GT(region().matte->edge.choke_px, 0.5);
    ASSERT_TRUE(robot->click("Key Choke"));
    robot->frames(3);
    EXPECT_TRUE(region().matte->edge.choke_keys.has(session->view().frame));
    const double kept = region().matte->edge.choke_px;
    paint_holdout();
    robot->wheel(60);
    robot->frames(3);
    ASSERT_TRUE(robot->drag("Edge/Blur", {20, 0}));
    robot->frames(3);
    EXPECT_GT(region().holdouts->at(0).edge.blur_px, 0);
    EXPECT_EQ(region().matte->edge.blur_px, 0);
    EXPECT_EQ(region().matte->edge.choke_px, kept);
    robot->key("Ctrl+Z");
    robot->frames(3);
    EXPECT_EQ(region().holdouts->at(0).edge.blur_px, 0);
}

}  // namespace
}  // namespace weft::test
