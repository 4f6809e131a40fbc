// Nothing moves under the pointer when something becomes known, and no text is clipped.
#include <algorithm>
#include <cfloat>
#include <chrono>
#include <filesystem>
#include <thread>

#include "engine/media/frame_writer.h"
#include "tests/ui/canvas_fixture.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class SteadyPanels : public CanvasTest {
  protected:
    float top_of(const std::string& name) {
        robot->frames(2);
        const DrawnItem* found = robot->find(name);
        EXPECT_NE(found, nullptr) << name;
        return found ? found->min.y : -1;
    }
    bool there(const std::string& name) {
        robot->frames(2);
        return robot->find(name) != nullptr;
    }
    /// The first region has a matte that is painted on one frame.
    void paint_key() {
        view.selected = view.project.regions[0]->id;
        view.project.regions[0] = view.project.regions[0].with([](Region& r) {
            r.matte = r.matte.with([](MatteSource& m) {
                m.files.clear();
                m.keyframes[1001].path = "key.png";
            });
        });
    }
};

TEST_F(SteadyPanels, TheTexturesStayWhereTheyAreWhenOneIsSelected) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(::testing::TempDir()) / "weft_steady_textures";
    fs::remove_all(folder);
    fs::create_directories(folder / "wood");
    for (int k = 10; k < 40; ++k)
        ASSERT_TRUE(write_image((folder / "wood" / ("plank" + std::to_string(k) + ".png")).string(),
                                ImageF3(8, 8), {}, {}));
    shell->textures().scan({folder.string()});
    go("Texture", Tool::kPan);
    for (int k = 0; k < 500 && !there("Textures/Plank20"); ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const DrawnItem* card = robot->find("Textures/Plank20");
    ASSERT_NE(card, nullptr);
    const ImVec2 before = card->min;
    // That of the region until one is selected.
    view.selected = view.project.regions[0]->id;
    view.path = (folder / "shot.weft").string();
    view.project.regions[0] = view.project.regions[0].with([](Region& r) {
        r.texture = {};
        r.texture.sample = "other/not listed.png";
    });
    ASSERT_TRUE(there("Large/Apply to region"));
    EXPECT_FALSE(robot->find("Large/Apply to region")->enabled) << "it has that one";
    ASSERT_TRUE(robot->click("Textures/Plank20"));
    for (int k = 0; k < 60; ++k)
        robot->frames(1);
    ASSERT_TRUE(there("Large/Apply to region"));
    EXPECT_TRUE(robot->find("Large/Apply to region")->enabled);
    card = robot->find("Textures/Plank20");
    ASSERT_NE(card, nullptr);
    EXPECT_EQ(card->min.x, before.x);
    EXPECT_EQ(card->min.y, before.y);
    fs::remove_all(folder);
}

TEST_F(SteadyPanels, WhatATextureIsTakenForMovesNothing) {
    go("Texture", Tool::kPan);
    const RegionId region = view.project.regions[0]->id;
    view.selected = region;
    view.project.regions[0] = view.project.regions[0].with([](Region& r) {
        r.texture = {};
        r.texture.sample = "/textures/brick.png";
    });
    view.preview.samples.clear();
    const float before = top_of("Placement/Scale");
    view.preview.samples[region] = "stochastic: no unit repeats, so patches are laid freely";
    EXPECT_EQ(top_of("Placement/Scale"), before);
    view.preview.samples[region] =
        "periodic: its units are kept whole, every 124.5 × 0.0 px and every 0.0 × 124.5 px";
    EXPECT_EQ(top_of("Placement/Scale"), before);
}

TEST_F(SteadyPanels, NothingMovesWhenASurfaceHasBeenGathered) {
    go("Texture", Tool::kPan);
    view.selected = view.project.regions[0]->id;
    view.paint_programs = {{"Krita", "krita", ".ora"}, {"GIMP", "gimp", ".ora"}};
    const float before = top_of("Placement/Scale");
    view.flattening = FlattenView{view.selected, WorkStage::kWait, 100, 118, 94};
    EXPECT_EQ(top_of("Placement/Scale"), before);
    clear();
    ASSERT_TRUE(robot->click("Cancel gathering"));
    EXPECT_THAT(emitted<StopPaintFlat>(), SizeIs(1));
}

TEST_F(SteadyPanels, WhatAFormIsFoundFromMovesNothing) {
    go("Texture", Tool::kPan);
    view.selected = view.project.regions[0]->id;
    view.preview.forms.clear();
    const float before = top_of("Cylinder");
    view.preview.forms[view.selected] =
        "Flat, because neither motion nor lines tell its form well enough";
    EXPECT_EQ(top_of("Cylinder"), before);
}

TEST_F(SteadyPanels, TheButtonsOfPropagationStayWhereTheyAre) {
    paint_key();
    go("Mask", Tool::kBrush);
    view.reached.clear();
    for (FrameMarks& mark : view.marks)
        mark.confidence = -1;
    const float bar = top_of("Propagation/Reached 0"), pause = top_of("Propagation/Pause");
    // The mattes of before are still shown, so it has not "propagated to 0 frames".
    EXPECT_TRUE(there("About: Frames still to come show what they showed before the last change."));
    view.reached = view.plate.frames;
    EXPECT_EQ(top_of("Propagation/Propagated"), bar);
    EXPECT_EQ(top_of("Propagation/Pause"), pause);
    const std::string strip =
        "About: The strip below the ruler is pale where the confidence is low.";
    EXPECT_FALSE(there(strip)) << "there is no strip yet";
    view.marks[0].confidence = 0.9f;
    EXPECT_TRUE(there(strip));
    EXPECT_EQ(top_of("Propagation/Pause"), pause);
}

TEST_F(SteadyPanels, SuggestedKeyframesComeAndGoInTheirPlace) {
    paint_key();
    for (const char* workspace : {"Motion", "Mask"}) {
        go(workspace, Tool::kPan);
        const std::string below =
            workspace == std::string("Motion") ? "Pin texture" : "Freeze and export";
        view.to_correct.clear();
        const float before = top_of(below);
        for (int k = 0; k < 5; ++k) {
            view.to_correct.push_back({1002 + k, CorrectionHint::Kind::kMatte, 0.3f});
            EXPECT_EQ(top_of(below), before) << k;
        }
        EXPECT_TRUE(there("Hints/Hint 1004"));
        EXPECT_FALSE(there("Hints/Hint 1005")) << "the timeline shows it";
    }
}

TEST_F(SteadyPanels, TheCardsOfASmallWindowSayWhatTheyWaitFor) {
    ImGui::GetIO().DisplaySize = {1280, 720};
    shell->state().strip = StripKind::kKeyframes;
    view.strip = {};
    view.strip.kind = StripKind::kKeyframes;
    for (int k = 0; k < 8; ++k) {
        view.strip.cards.emplace_back();
        view.strip.cards.back().frame = 1001 + k;
        view.strip.cards.back().label = "Frame " + std::to_string(1001 + k);
    }
    view.preview.analysing = true;
    view.preview.done = 12;
    view.preview.total = 100;
    go("Seams & Light", Tool::kPan);
    EXPECT_TRUE(there("Card: After the analysis, 12%"));
    auto picture = std::make_shared<Picture>();
    picture->size = {16, 9};
    view.strip.cards[0].picture = picture;
    view.strip.cards[0].provisional = true;
    EXPECT_TRUE(there("Mark: Provisional"));
}

TEST_F(SteadyPanels, TheNextSuggestedFrameSaysThatThereIsNone) {
    std::vector<std::string> said;
    shell->notify = [&](NoticeKind, std::string text) { said.push_back(std::move(text)); };
    robot->frames(2);
    view.to_correct.clear();
    for (FrameMarks& mark : view.marks)
        mark = {};
    clear();
    robot->key("Ctrl+Right");
    EXPECT_THAT(said, ::testing::ElementsAre("No suggestions until the shot is analysed."));
    EXPECT_THAT(emitted<GoToFrame>(), IsEmpty());
    view.marks[0].confidence = 0.9f;
    robot->key("Ctrl+Right");
    ASSERT_THAT(said, SizeIs(2));
    EXPECT_EQ(said[1], "No frame needs a keyframe.");
}

TEST_F(SteadyPanels, ThePictureStaysWhereItIsWhenARenderIsMeasured) {
    go("Review", Tool::kPan);
    view.report = {};
    robot->frames(2);
    const float before = robot->find("Viewer/Canvas")->max.y;
    view.report.state = QualityReport::State::kDone;
    for (int frame : {1001, 1002, 1003}) {
        view.report.rows.emplace_back();
        view.report.rows.back().frame = frame;
    }
    robot->frames(2);
    EXPECT_EQ(robot->find("Viewer/Canvas")->max.y, before);
}

TEST_F(SteadyPanels, NothingInTheStatusBarIsWrittenOverSomethingElse) {
    view.jobs.resize(1);
    view.jobs[0] = {};
    view.jobs[0].id = 12;
    view.jobs[0].state = JobState::kRunning;
    view.jobs[0].stage = WorkStage::kWait;
    view.jobs[0].done = 117;
    view.jobs[0].total = 117;
    view.preview.analysing = true;
    view.preview.done = 1;
    view.preview.total = 2;
    robot->frames(2);
    const DrawnItem* analysis = robot->find("Status: Analysing 50%");
    ASSERT_NE(analysis, nullptr);
    const auto& items = shell->items();
    const auto job = std::find_if(items.begin(), items.end(), [](const DrawnItem& item) {
        return item.name.find("Status: Job 12") != std::string::npos;
    });
    ASSERT_NE(job, items.end());
    const std::string text = job->name.substr(job->name.find("Job 12"));
    const ImFont* font = shell->theme().small;
    EXPECT_LT(job->min.x + font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text.c_str()).x,
              analysis->min.x);
}

TEST_F(SteadyPanels, AMovieThatIsOpenedSaysHowFarItIsRead) {
    view.plate = {};
    view.plate.state = PlateView::State::kOpening;
    view.plate.path = "/shots/long.mov";
    view.plate_picture.reset();
    EXPECT_TRUE(there("Opening the plate…"));
    view.plate.counted = 1234;
    EXPECT_TRUE(there("Counting the movie's frames: 1234"));
}

TEST_F(SteadyPanels, WhatIsTypedInADialogThatOpensIsAPath) {
    robot->frames(2);
    robot->key("Ctrl+O");
    robot->frames(3);
    ASSERT_EQ(shell->state().browser.purpose, BrowserState::Purpose::kOpen);
    robot->key("Ctrl+A");
    robot->type("/tmp");
    EXPECT_EQ(shell->state().browser.folder, "/tmp");
}

TEST_F(SteadyPanels, LeavingWhileASurfaceIsGatheredAsks) {
    view.modified = false;
    view.jobs.clear();
    view.flattening = FlattenView{view.project.regions[0]->id, {}, 3, 10, 0};
    robot->frames(2);
    shell->ask_to_leave();
    robot->frames(2);
    EXPECT_FALSE(shell->state().leave);
    ASSERT_TRUE(robot->click("Leave"));
    EXPECT_TRUE(shell->state().leave);
    shell->state().leave = false;
    shell->ask_to_leave();
    robot->frames(2);
    view.flattening.reset();
    robot->frames(2);
    EXPECT_TRUE(shell->state().leave) << "it is gathered meanwhile";
}

}  // namespace
}  // namespace weft::test
