// The line below the picture says what is shown, not only what is worked on.
#include "tests/ui/canvas_fixture.h"

namespace weft::test {
namespace {

class StateLine : public PanelTest {
  protected:
    void SetUp() override {
        PanelTest::SetUp();
        view.result_current = false;
        view.stages = {};
        view.preview = {};
        shell->state().workspace = Workspace::kTexture;
        shell->state().tool = Tool::kPan;
    }
    bool shows(const std::string& text) {
        robot->frames(2);
        return robot->find("State: " + text) != nullptr;
    }
};

TEST_F(StateLine, DoesNotCallAnOlderResultThePlate) {
    view.preview.state = PreviewView::State::kAnalysing;
    view.preview.done = 3;
    view.preview.total = 71;
    EXPECT_TRUE(shows("Updating…  ·  Analysing 4%"));
    view.preview.state = PreviewView::State::kOpening;
    EXPECT_TRUE(shows("Updating…"));
    view.analysis_paused = true;
    view.preview.state = PreviewView::State::kAnalysing;
    EXPECT_TRUE(shows("Outdated result  ·  Analysis paused"));
}

TEST_F(StateLine, SaysThatThePlateIsShownWhereThereIsNoResult) {
    view.result_picture = nullptr;
    view.preview.state = PreviewView::State::kOpening;
    EXPECT_TRUE(shows("Plate  ·  Preparing the result…"));
    view.preview.state = PreviewView::State::kAnalysing;
    EXPECT_TRUE(shows("Plate  ·  Analysing"));
}

TEST_F(StateLine, SaysWhatAProvisionalPictureWaitsFor) {
    view.stages.provisional = true;
    view.preview.state = PreviewView::State::kGrowing;
    EXPECT_TRUE(shows("Provisional  ·  synthesizing the texture"));
}

TEST_F(StateLine, SaysThatAMaskIsPaintedOverThePlate) {
    view.result_current = true;
    EXPECT_TRUE(shows("Result, draft"));
    shell->state().workspace = Workspace::kMask;
    shell->state().tool = Tool::kBrush;
    EXPECT_TRUE(shows("Plate"));
    view.preview.analysing = true;
    view.preview.done = 1;
    view.preview.total = 4;
    EXPECT_TRUE(shows("Plate  ·  analysing 25%"));
    // After the first save: the shot is opened again.
    view.preview = {};
    view.preview.state = PreviewView::State::kOpening;
    view.result_current = false;
    EXPECT_TRUE(shows("Plate  ·  preparing the result…"));
    view.analysis_paused = true;
    EXPECT_TRUE(shows("Plate  ·  analysis paused"));
}

// In a small window the time is worth more than the word.
TEST_F(StateLine, IsNotClippedOnASmallScreen) {
    ImGui::GetIO().DisplaySize = {1280, 720};
    view.stages.provisional = true;
    view.preview.analysing = true;
    view.preview.state = PreviewView::State::kAnalysing;
    view.preview.done = 2;
    view.preview.total = 100;
    view.preview.seconds_left = 316;
    EXPECT_TRUE(shows("Provisional  ·  analysing 2%, 5:16 left"));
    EXPECT_NE(robot->find("State shown: Provisional  ·  2%, 5:16 left"), nullptr);
    ImGui::GetIO().DisplaySize = {1920, 1080};
    robot->frames(2);
    EXPECT_NE(robot->find("State shown: Provisional  ·  analysing 2%, 5:16 left"), nullptr);
}

class MatteState : public CanvasTest {
  protected:
    RegionMatteView& matte() {
        view.selected = view.project.regions[0]->id;
        view.mattes.resize(1);
        view.mattes[0].region = view.selected;
        return view.mattes[0];
    }
    bool says(const std::string& text) {
        robot->frames(2);
        return robot->find("Matte state: " + text) != nullptr;
    }
};

TEST_F(MatteState, IsSaidOnThePictureWhereItIsNotThatOfTheDocument) {
    go("Mask", Tool::kBrush);
    matte().kind = RegionMatteView::Kind::kUnreached;
    EXPECT_TRUE(says("The matte has not reached this frame  ·  propagating…"));
    view.analysis_paused = true;
    EXPECT_TRUE(says("The matte has not reached this frame  ·  analysis paused"));
    view.analysis_paused = false;
    matte().kind = RegionMatteView::Kind::kPropagated;
    matte().outdated = true;
    EXPECT_TRUE(says("Matte before the last change  ·  propagating…"));
    matte().outdated = false;
    EXPECT_FALSE(says("Matte before the last change  ·  propagating…"));
}

TEST_F(MatteState, NothingMovesWithTheFirstCorrection) {
    const auto change = [&](auto&& what) {
        view.project.regions[0] = view.project.regions[0].with(
            [&](Region& r) { r.matte = r.matte.with([&](MatteSource& m) { what(m); }); });
        robot->frames(2);
    };
    (void)matte();
    go("Mask", Tool::kBrush);
    change([](MatteSource& m) {
        m.files.clear();
        m.keyframes[1001].path = "key.png";
    });
    const DrawnItem* before = robot->find("Edge/Choke");
    ASSERT_NE(before, nullptr);
    const float at = before->min.y;
    change([](MatteSource& m) { m.confirmed[1002].path = "part.png"; });
    EXPECT_EQ(robot->find("Edge/Choke")->min.y, at);
}

TEST_F(MatteState, TheShotIsPropagatedWhenAllItsFramesAre) {
    view.project.regions[0] = view.project.regions[0].with([](Region& r) {
        r.matte = r.matte.with([](MatteSource& m) {
            m.files.clear();
            m.keyframes[1001].path = "key.png";
        });
    });
    (void)matte();
    view.preview.analysing = false;
    view.reached = {1001, 1002};
    go("Mask", Tool::kBrush);
    EXPECT_NE(robot->find("Propagation/Reached 2"), nullptr);
    EXPECT_EQ(robot->find("Propagation/Propagated"), nullptr);
    view.reached = view.plate.frames;
    robot->frames(2);
    EXPECT_NE(robot->find("Propagation/Propagated"), nullptr);
}

}  // namespace
}  // namespace weft::test
