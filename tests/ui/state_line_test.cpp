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
    EXPECT_TRUE(shows("Updating…  ·  Analysing 3/71"));
    view.preview.state = PreviewView::State::kOpening;
    EXPECT_TRUE(shows("Updating…"));
    view.analysis_paused = true;
    view.preview.state = PreviewView::State::kAnalysing;
    EXPECT_TRUE(shows("Outdated result  ·  Analysis paused"));
}

TEST_F(StateLine, SaysThatThePlateIsShownWhereThereIsNoResult) {
    view.result_picture = nullptr;
    view.preview.state = PreviewView::State::kOpening;
    EXPECT_TRUE(shows("Opening the shot…"));
    view.preview.state = PreviewView::State::kAnalysing;
    EXPECT_TRUE(shows("Plate  ·  Analysing"));
}

TEST_F(StateLine, SaysWhatAProvisionalPictureWaitsFor) {
    view.stages.provisional = true;
    view.preview.state = PreviewView::State::kGrowing;
    EXPECT_TRUE(shows("Provisional  ·  synthesizing the texture"));
}

}  // namespace
}  // namespace weft::test
