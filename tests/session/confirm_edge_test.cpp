// "This edge is right": strokes that count for a part of a propagated frame only.
#include "engine/media/image_files.h"
#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

class ConfirmEdge : public SessionByActions {
  protected:
    void open_propagated() {
        open();
        paint();
        act(GoToFrame{3});
        ASSERT_TRUE(wait([&] {
            return view().frame == 3 && view().mattes.size() == 1 && view().mattes[0].keep &&
                   view().mattes[0].kind == RegionMatteView::Kind::kPropagated;
        }));
    }
    void stroke(StrokeKind kind, Vec2 from, Vec2 to, bool subtract = false) {
        Brush brush = pen();
        brush.subtract = subtract;
        act(BeginStroke{brush, from, 1, kind});
        act(ContinueStroke{to, 1});
        act(EndStroke{});
        update();
    }
    [[nodiscard]] Matte file(const std::string& path) {
        session_->flush();
        const auto read = read_matte(path, {}, {96, 64});
        EXPECT_TRUE(read) << (read ? "" : read.error().text());
        return read ? *read : Matte();
    }
    [[nodiscard]] const std::map<int, ConfirmedEdge>& confirmed() const {
        return region().matte->confirmed;
    }
};

TEST_F(ConfirmEdge, KeepsTheMatteAndWhereItIsRight) {
    open_propagated();
    const MattePtr shown = view().mattes[0].keep;
    stroke(StrokeKind::kConfirm, {24, 30}, {30, 40});
    ASSERT_TRUE(confirmed().contains(3));
    EXPECT_FALSE(region().matte->keyframes.contains(3)) << "the rest is propagated";
    EXPECT_EQ(file(confirmed().at(3).path), *shown);
    const Matte area = file(confirmed().at(3).area);
    EXPECT_EQ(area.at(26, 32), 255);
    EXPECT_EQ(area.at(60, 32), 0);
    EXPECT_TRUE(view().marks[2].confirmed);
    EXPECT_FALSE(view().marks[2].matte_key);
    ASSERT_TRUE(wait([&] { return !view().confirmed.pixels.empty(); }));
    EXPECT_EQ(view().confirmed.pixels.at(26, 32), 255);

    // More of it, and less.
    stroke(StrokeKind::kConfirm, {60, 30}, {60, 34});
    EXPECT_EQ(file(confirmed().at(3).area).at(60, 32), 255);
    stroke(StrokeKind::kConfirm, {60, 26}, {60, 38}, true);
    EXPECT_EQ(file(confirmed().at(3).area).at(60, 32), 0);
    EXPECT_EQ(file(confirmed().at(3).area).at(26, 32), 255);
    for (int k = 0; k < 3; ++k)
        act(Undo{});
    update();
    EXPECT_TRUE(confirmed().empty());
    EXPECT_FALSE(view().marks[2].confirmed);
    EXPECT_TRUE(view().confirmed.pixels.empty());
}

TEST_F(ConfirmEdge, GoesWithTheLastOfItsArea) {
    open_propagated();
    stroke(StrokeKind::kConfirm, {24, 30}, {30, 30});
    ASSERT_FALSE(confirmed().empty());
    stroke(StrokeKind::kConfirm, {10, 30}, {50, 30}, true);
    EXPECT_TRUE(confirmed().empty());
}

TEST_F(ConfirmEdge, IsRefusedWhereAllIsRightOrNothingIsThere) {
    open();
    stroke(StrokeKind::kConfirm, {24, 30}, {30, 30});
    EXPECT_TRUE(region().matte->empty());
    ASSERT_FALSE(view().notices.empty());
    EXPECT_NE(view().notices.back().text.find("Paint a keyframe first"), std::string::npos);
    paint();
    const int key = region().matte->keyframes.begin()->first;
    act(GoToFrame{key});
    update();
    stroke(StrokeKind::kConfirm, {24, 30}, {30, 30});
    EXPECT_TRUE(confirmed().empty());
    EXPECT_NE(view().notices.back().text.find("whole matte counts as right"), std::string::npos);
}

TEST_F(ConfirmEdge, ACorrectionCountsWhereItWasPainted) {
    open_propagated();
    const Matte before = *view().mattes[0].keep;
    stroke(StrokeKind::kHere, {75, 50}, {85, 50});
    ASSERT_TRUE(confirmed().contains(3));
    EXPECT_EQ(region().matte->keyframes.size(), 1u);
    const Matte matte = file(confirmed().at(3).path), area = file(confirmed().at(3).area);
    EXPECT_EQ(matte.at(80, 50), 255);
    EXPECT_EQ(area.at(80, 50), 255);
    EXPECT_EQ(matte.at(40, 32), before.at(40, 32));
    EXPECT_EQ(area.at(40, 32), 0);
    // It shows at once, and stays when the frame has been propagated again.
    EXPECT_EQ(view().mattes[0].pixels.at(80, 50), 255);
    ASSERT_TRUE(
        wait([&] { return view().mattes[0].keep && view().mattes[0].keep->at(80, 50) == 255; }));
    act(GoToFrame{4});
    EXPECT_TRUE(wait([&] {
        return view().frame == 4 && view().mattes[0].keep &&
               view().mattes[0].keep->at(80, 50) > 127;
    })) << "it is propagated from there";
}

TEST_F(ConfirmEdge, AnOutlineCountsWhereItChangesTheMatte) {
    open_propagated();
    const Matte before = *view().mattes[0].keep;
    act(FillPolygon{{{70, 44}, {90, 44}, {90, 60}, {70, 60}}, false, true});
    ASSERT_TRUE(wait([&] { return confirmed().contains(3); }));
    EXPECT_EQ(region().matte->keyframes.size(), 1u);
    const Matte matte = file(confirmed().at(3).path), area = file(confirmed().at(3).area);
    EXPECT_EQ(matte.at(80, 50), 255);
    EXPECT_EQ(area.at(80, 50), 255);
    EXPECT_EQ(area.at(80, 42), 255) << "the new edge lies inside";
    EXPECT_EQ(area.at(80, 36), 0);
    EXPECT_EQ(matte.at(40, 32), before.at(40, 32));
    act(FillPolygon{{{70, 44}, {90, 44}, {90, 60}, {70, 60}}, true, false});
    ASSERT_TRUE(wait([&] { return region().matte->keyframes.contains(3); }));
    EXPECT_TRUE(confirmed().empty());
}

TEST_F(ConfirmEdge, AKeyframeReplacesItAndAStrokeOnAKeyframeStaysOne) {
    open_propagated();
    stroke(StrokeKind::kConfirm, {24, 30}, {30, 30});
    ASSERT_FALSE(confirmed().empty());
    stroke(StrokeKind::kKeyframe, {24, 30}, {30, 30});
    EXPECT_TRUE(confirmed().empty());
    EXPECT_TRUE(region().matte->keyframes.contains(3));
    stroke(StrokeKind::kHere, {60, 30}, {64, 30});
    EXPECT_TRUE(confirmed().empty()) << "all of a keyframe counts";
    EXPECT_EQ(file(region().matte->keyframes.at(3).path).at(62, 30), 255);
}

}  // namespace
}  // namespace weft::test
