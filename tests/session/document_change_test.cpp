// Opening another shot: nothing of the one before is shown or written to.
#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;

class DocumentChange : public SessionByActions {
  protected:
    void open_b() {
        write_shot("b/frames");
        act(OpenAny{in("b/frames")});
        update();
    }
    void add_region_b() {
        Region region;
        region.name = "b";
        act(DoEdit{AddRegion{region, {}}});
    }
    void texture_a() {
        open();
        paint();
        act(ApplyTexture{in("tile.png"), 0});
        ASSERT_TRUE(wait([&] { return view().result_current; })) << view().preview.error;
    }
};

TEST_F(DocumentChange, NothingIsShownOfTheShotBefore) {
    texture_a();
    act(ShowStrip{StripKind::kLight, {}, false});
    act(ShowOverlay{Overlay::kGrid});
    act(ShowStages{true});
    act(ShowLayer{LayerKind::kLight});
    act(MarkRange{2, 3});
    act(SoloRegion{view().selected});
    ASSERT_TRUE(wait([&] { return !view().strip.cards.empty(); }));
    const std::uint64_t document = view().document;
    const PicturePtr plate_of_a = view().plate_picture;
    open_b();
    EXPECT_NE(view().document, document);
    EXPECT_EQ(view().result_picture, nullptr);
    EXPECT_NE(view().plate_picture, plate_of_a);
    EXPECT_THAT(view().strip.cards, IsEmpty());
    EXPECT_THAT(view().mattes, IsEmpty());
    EXPECT_EQ(view().overlay, Overlay::kNone);
    EXPECT_FALSE(view().stages_shown);
    EXPECT_FALSE(view().layer);
    EXPECT_FALSE(view().mark_in);
    EXPECT_EQ(view().solo, 0u);
    EXPECT_EQ(view().report.state, QualityReport::State::kNone);
    ASSERT_TRUE(wait([&] { return view().plate_picture != nullptr; }));
    EXPECT_EQ(view().result_picture, nullptr);
}

// The second shot has a region of the same id, painted on the same frame.
TEST_F(DocumentChange, PropagatedMattesAreNotTakenFromTheShotBefore) {
    texture_a();
    act(GoToFrame{3});
    ASSERT_TRUE(wait([&] {
        return view().frame == 3 && view().mattes.size() == 1 && view().mattes[0].keep != nullptr;
    }));
    open_b();
    ASSERT_TRUE(wait([&] { return view().plate_picture != nullptr; }));
    act(PauseAnalysis{true});
    act(GoToFrame{1});
    add_region_b();
    update();
    ASSERT_EQ(view().mattes.size(), 1u);
    act(BeginStroke{pen(), {80, 8}, 1});
    act(EndStroke{});
    act(GoToFrame{3});
    for (int k = 0; k < 50; ++k) {
        update();
        std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
    const RegionMatteView& matte = view().mattes[0];
    if (matte.keep) {
        EXPECT_EQ(matte.pixels.at(50, 34), 0) << "the matte of the first shot";
    }
}

TEST_F(DocumentChange, WhatIsStillWorkedOutIsDropped) {
    open();
    paint();
    act(GrowMatte{2});        // in the background
    act(FreezeMattes{true});  // likewise
    open_b();
    add_region_b();
    session_->flush();
    for (int k = 0; k < 20; ++k)
        update();
    EXPECT_TRUE(region().matte->empty());
    EXPECT_EQ(view().history.size(), 2u);
}

// Both were never saved: the save of the first one must not make the second one its file.
TEST_F(DocumentChange, ASaveThatEndsLateKeepsToItsShot) {
    open();
    paint();
    act(SaveAs{in("a.weft")});
    open_b();
    session_->flush();
    update();
    EXPECT_TRUE(fs::exists(in("a.weft")));
    EXPECT_EQ(view().path, "");
    EXPECT_EQ(view().title, "b");
}

}  // namespace
}  // namespace weft::test
