// From user input to the document, without a window.
#include <algorithm>
#include <fstream>
#include <thread>

#include "app/base/trust.h"
#include "app/exchange/track_file.h"
#include "app/project/codec/project_file.h"
#include "engine/media/image_files.h"
#include "tests/ui/ui_harness.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class EditorSession : public SessionTest {
  protected:
    void open() {
        session->act(OpenAny{(folder / "frames").string()});
        ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }))
            << session->view().plate.error;
        robot->frames(3);
    }
    void paint() {
        robot->key("Ctrl+Shift+N");  // a region
        robot->key("B");
        robot->frames(3);
        robot->stroke({at(30, 30), at(40, 32), at(50, 34)});
        robot->frames(3);
    }
    [[nodiscard]] const Project& project() const { return session->view().project; }
    [[nodiscard]] const MatteSource& matte() const { return *project().regions.back()->matte; }
};

TEST_F(EditorSession, AFolderOpensAsItsSequence) {
    open();
    EXPECT_THAT(project().plate.path, testing::EndsWith("frames/####.png"));
    EXPECT_EQ(session->view().plate.frames, (std::vector<int>{1, 2, 3, 4}));
    EXPECT_EQ(session->view().frame, 1);
}

TEST_F(EditorSession, AStrokeBecomesAKeyframeWithItsFile) {
    open();
    paint();
    ASSERT_EQ(matte().keyframes.size(), 1u);
    ASSERT_TRUE(matte().keyframes.contains(1));
    session->flush();
    const auto written = read_matte(matte().keyframes.at(1).path, {}, {96, 64});
    ASSERT_TRUE(written) << written.error().text();
    EXPECT_GT(written->at(40, 32), 200);
    EXPECT_EQ(written->at(2, 2), 0);
}

// The preview uses the stroke from memory, even if the disk fails.
TEST_F(EditorSession, AStrokeIsPreviewedEvenIfItCannotBeWritten) {
    fs::create_directories(folder / "state");
    std::ofstream(folder / "state" / "unsaved") << "in the place of the folder";
    open();
    paint();
    session->act(ApplyTexture{(folder / "tile.png").string(), 0});
    ASSERT_TRUE(wait([&] {
        return session->view().result_current ||
               session->view().preview.state == PreviewView::State::kFailed;
    }));
    EXPECT_TRUE(session->view().result_current) << session->view().preview.error;
    EXPECT_FALSE(fs::exists(matte().keyframes.at(1).path));
    const auto& notices = session->view().notices;
    EXPECT_TRUE(std::any_of(notices.begin(), notices.end(), [](const Notice& n) {
        return n.kind == NoticeKind::kError;
    })) << "and the artist is told";
}

// A frame of the screen is all that lies between the pen and its trace: what the pointer did before
// a frame is in the picture of that very frame.
TEST_F(EditorSession, TheStrokeIsInTheFrameThatSeesThePointerMove) {
    open();
    robot->key("Ctrl+Shift+N");
    robot->key("B");
    shell->state().brush.brush.radius_px = 3;
    shell->state().brush.brush.hardness = 1;
    robot->frames(3);
    struct Drawn {
        int frame = 0, coverage = -1;
        Recti changed;
    };
    int frame_number = 0;
    std::vector<Drawn> drawn;
    Vec2i probe;
    pictures.on_matte = [&](const MatteDraw& draw) {
        drawn.push_back({frame_number, draw.pixels.at(probe.x, probe.y), draw.changed});
    };
    const std::vector<Vec2i> way{{20, 20}, {30, 22}, {40, 30}, {50, 28}, {60, 40}, {70, 44}};
    robot->move(at(20.5f, 20.5f));
    for (std::size_t k = 0; k < way.size(); ++k) {
        // The input of this frame …
        ++frame_number;
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = at(static_cast<float>(way[k].x) + 0.5f, static_cast<float>(way[k].y) + 0.5f);
        io.MouseDown[0] = true;
        probe = way[k];
        drawn.clear();
        frame();
        // … is in what this frame draws, and uploads no more than it must.
        ASSERT_FALSE(drawn.empty()) << k;
        EXPECT_EQ(drawn.back().frame, frame_number);
        EXPECT_EQ(drawn.back().coverage, 255) << "point " << k << " came late";
        EXPECT_TRUE(drawn.back().changed.contains(probe.x, probe.y)) << k;
        if (k > 0) {
            EXPECT_LT(drawn.back().changed.width(), 30) << k;
        }
    }
    robot->release();
    robot->frames(2);
    pictures.on_matte = nullptr;
    EXPECT_EQ(matte().keyframes.size(), 1u);
}

TEST_F(EditorSession, OneStrokeIsOneStepOfTheHistory) {
    open();
    paint();
    const std::string first = matte().keyframes.at(1).path;
    robot->stroke({at(60, 20), at(62, 22)});
    robot->frames(3);
    const std::string second = matte().keyframes.at(1).path;
    EXPECT_NE(first, second);
    robot->key("Ctrl+Z");
    robot->frames(2);
    EXPECT_EQ(matte().keyframes.at(1).path, first);
    robot->key("Ctrl+Z");
    robot->frames(2);
    EXPECT_TRUE(matte().keyframes.empty());
    robot->key("Ctrl+Shift+Z");
    robot->frames(2);
    EXPECT_EQ(matte().keyframes.at(1).path, first);
}

TEST_F(EditorSession, AltSubtractsFromTheMatte) {
    open();
    paint();
    robot->hold("Alt", true);
    robot->stroke({at(40, 32), at(42, 33)});
    robot->hold("Alt", false);
    robot->frames(3);
    session->flush();
    const auto written = read_matte(matte().keyframes.at(1).path, {}, {96, 64});
    ASSERT_TRUE(written);
    EXPECT_LT(written->at(41, 32), 20);
}

TEST_F(EditorSession, ALockedRegionIsNotPainted) {
    open();
    paint();
    const auto before = matte();
    session->act(LockRegion{session->view().selected, true});
    robot->frames(2);
    robot->stroke({at(60, 20), at(62, 22)});
    robot->frames(3);
    EXPECT_EQ(matte(), before);
    EXPECT_FALSE(session->view().notices.empty());
}

TEST_F(EditorSession, SavingMakesPathsRelativeAndOpensAgain) {
    open();
    paint();
    const std::string path = (folder / "shot.weft").string();
    session->act(SaveAs{path});
    EXPECT_TRUE(session->view().saving);
    ASSERT_TRUE(wait([&] { return !session->view().saving; }));
    robot->frames(2);
    EXPECT_FALSE(session->view().modified);
    EXPECT_EQ(project().plate.path, "frames/####.png");
    const Project before = project();
    restart_session();
    session->act(OpenProject{path});
    ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
    EXPECT_EQ(project(), before);
}

TEST_F(EditorSession, PaintingIsRecoveredAfterACrash) {
    open();
    paint();
    session->flush();
    const fs::path recovery = folder / "state" / "recovery";
    fs::path snapshot;
    for (const auto& entry : fs::directory_iterator(recovery))
        snapshot = entry.path();
    ASSERT_FALSE(snapshot.empty());
    // As if a process that has ended had left it.
    fs::copy_file(snapshot, recovery / "recovery-999999999.weft");
    const MatteSource painted = matte();
    restart_session();
    robot->frames(2);
    ASSERT_TRUE(session->view().recovery);
    ASSERT_TRUE(robot->click("Recover"));
    ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
    ASSERT_EQ(project().regions.size(), 1u);
    EXPECT_EQ(matte(), painted);
    EXPECT_TRUE(session->view().modified);
    EXPECT_FALSE(fs::exists(recovery / "recovery-999999999.weft"));
}

TEST_F(EditorSession, AMissingFrameIsReportedAndTheOthersPlay) {
    std::ofstream(folder / "frames" / "0003.png") << "no picture";
    open();
    robot->key("Right");
    robot->key("Right");
    ASSERT_TRUE(wait([&] { return !session->view().frame_error.empty(); }));
    EXPECT_THAT(session->view().frame_error, HasSubstr("0003.png"));
    robot->key("Right");
    ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
    EXPECT_EQ(session->view().frame, 4);
}

TEST_F(EditorSession, ThePreviewShowsTheResultAndNeverAWrongOne) {
    open();
    paint();
    ASSERT_FALSE(session->view().result_current);
    session->act(ApplyTexture{(folder / "tile.png").string(), 0});
    ASSERT_TRUE(wait([&] { return session->view().result_current; }))
        << session->view().preview.error;
    const PicturePtr first = session->view().result_picture;
    ASSERT_NE(first, nullptr);
    EXPECT_NE(first->at(40, 32), session->view().plate_picture->at(40, 32));
    EXPECT_EQ(first->at(2, 60), session->view().plate_picture->at(2, 60));
    session->act(GoToFrame{3});
    robot->frames(1);
    // Until the frame is there, no other frame's result stands in for it.
    std::vector<PicturePtr> shown;
    ASSERT_TRUE(wait([&] {
        shown.push_back(session->view().result_picture);
        return session->view().frame == 3 && session->view().result_current;
    })) << session->view().preview.error;
    EXPECT_NE(shown.back(), nullptr);
    EXPECT_NE(shown.back(), first);
    shown.pop_back();
    EXPECT_THAT(shown, testing::Each(testing::IsNull()));
}

TEST_F(EditorSession, AnUntrustedProjectWritesInsideItsFolderOnly) {
    open();
    paint();
    session->act(ApplyTexture{(folder / "tile.png").string(), 0});
    fs::create_directories(folder / "from_elsewhere");
    const std::string path = (folder / "from_elsewhere" / "shot.weft").string();
    const std::string outside = (folder / "outside" / "####.png").string();
    session->act(DoEdit{SetOutput{[&] {
        Output output;
        output.path = outside;
        return output;
    }()}});
    session->act(SaveAs{path});
    ASSERT_TRUE(wait([&] { return !session->view().saving; }));
    // Projects created here are trusted; received ones are not.
    EXPECT_FALSE(session->view().trust);
    EXPECT_TRUE(TrustList((folder / "trusted.json").string()).trusts(path));
    fs::remove(folder / "trusted.json");
    restart_session();
    session->act(OpenProject{path});
    ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
    ASSERT_TRUE(session->view().trust);
    EXPECT_EQ(session->view().trust->output, outside);
    ASSERT_TRUE(robot->click("Not now"));
    EXPECT_FALSE(session->view().trust);
    session->act(SubmitJob{"1-2", outside, "", false, false});
    robot->frames(2);
    EXPECT_TRUE(session->view().jobs.empty());
    ASSERT_FALSE(session->view().notices.empty());
    EXPECT_THAT(session->view().notices.back().text, HasSubstr(outside));
    // An output chosen by the user needs no trust.
    session->act(SubmitJob{"1-2", (folder / "chosen" / "####.png").string(), "", false, false});
    ASSERT_TRUE(wait([&] { return session->view().jobs.size() == 1; }));
    ASSERT_TRUE(session->view().trust);
    ASSERT_TRUE(robot->click("Trust"));
    EXPECT_FALSE(session->view().trust);
    session->act(SubmitJob{"1-2", outside, "", false, false});
    ASSERT_TRUE(wait([&] { return session->view().jobs.size() == 2; }));
    restart_session();
    session->act(OpenProject{path});
    EXPECT_FALSE(session->view().trust);
}

TEST_F(EditorSession, AFailedJobSaysWhy) {
    open();
    paint();
    session->act(ApplyTexture{(folder / "tile.png").string(), 0});
    session->act(SubmitJob{"1-2", (folder / "out" / "####.png").string(), "", false, false});
    ASSERT_TRUE(wait([&] {
        return !session->view().jobs.empty() && session->view().jobs[0].state == JobState::kFailed;
    }));
    EXPECT_FALSE(session->view().jobs[0].error.empty());
}

TEST_F(EditorSession, ShapesAreKeyedAndFilledInBetween) {
    open();
    robot->key("Ctrl+Shift+N");
    robot->frames(2);
    const auto square = [](float x) {
        RotoShape shape;
        for (const Vec2 at : {Vec2{x, 20}, Vec2{x + 20, 20}, Vec2{x + 20, 40}, Vec2{x, 40}})
            shape.points.push_back({at, {0, 0}, {0, 0}, 0});
        return shape;
    };
    const auto set = [&](int frame, float x) {
        session->act(GoToFrame{frame});
        robot->frames(2);
        session->act(SetShape{square(x)});
        return wait([&] { return matte().keyframes.contains(frame); });
    };
    ASSERT_TRUE(set(1, 10));
    ASSERT_TRUE(set(3, 50));
    robot->frames(2);
    EXPECT_EQ(session->view().shape_frames, (std::vector<int>{1, 3}));
    ASSERT_TRUE(session->view().shape);
    EXPECT_EQ(session->view().shape->points[0].at.x, 50);
    // From now on it is drawn on every frame, and none is painted.
    session->act(FollowShape{});
    robot->frames(2);
    EXPECT_TRUE(matte().keyframes.empty());
    ASSERT_EQ(matte().shape.keys.size(), 2u);
    session->act(GoToFrame{2});
    const auto drawn = [&]() -> const RegionMatteView* {
        for (const RegionMatteView& view : session->view().mattes)
            if (view.frame == 2 && view.kind == RegionMatteView::Kind::kFile) return &view;
        return nullptr;
    };
    ASSERT_TRUE(wait([&] { return drawn() && !drawn()->pixels.empty(); }));
    EXPECT_EQ(drawn()->pixels.at(40, 30), 255);  // 30 to 50
    EXPECT_EQ(drawn()->pixels.at(15, 30), 0);
    EXPECT_EQ(drawn()->pixels.at(65, 30), 0);
    ASSERT_TRUE(session->view().shape);
    EXPECT_NEAR(session->view().shape->points[0].at.x, 30, 0.01);
    // What lies between is no shape of its own; what is drawn there becomes one.
    EXPECT_EQ(session->view().shape_frames, (std::vector<int>{1, 3}));
    session->act(SetShape{square(20)});
    robot->frames(2);
    EXPECT_EQ(session->view().shape_frames, (std::vector<int>{1, 2, 3}));
    // Painting is refused, and says what to do.
    robot->key("B");
    robot->stroke({at(30, 30), at(40, 32)});
    robot->frames(3);
    EXPECT_TRUE(matte().keyframes.empty());
    // Back to painted keyframes, with the same shapes.
    session->act(DetachShape{});
    ASSERT_TRUE(wait([&] { return matte().keyframes.size() == 3; }));
    EXPECT_TRUE(matte().shape.empty());
    EXPECT_EQ(matte().keyframes.at(2).shape, square(20));
    robot->key("Ctrl+Z");
    robot->key("Ctrl+Z");
    robot->key("Ctrl+Z");
    robot->frames(2);
    EXPECT_FALSE(matte().keyframes.contains(2));
    EXPECT_TRUE(matte().keyframes.contains(3));
    session->act(GoToFrame{3});
    robot->frames(2);
    // Painting over a shape makes it an ordinary matte.
    robot->key("B");
    robot->stroke({at(30, 30), at(40, 32)});
    robot->frames(3);
    EXPECT_EQ(session->view().shape_frames, (std::vector<int>{1}));
}

// The track is stored, so that a render does not depend on the analysis that it came from.
TEST_F(EditorSession, AShapeFollowsTheSurfacesOwnMotion) {
    open();
    robot->key("Ctrl+Shift+N");
    robot->frames(2);
    RotoShape shape;
    for (const Vec2 at : {Vec2{26, 18}, Vec2{62, 18}, Vec2{62, 46}, Vec2{26, 46}})
        shape.points.push_back({at, {0, 0}, {0, 0}, 0});
    session->act(FollowShape{ShapeFollow::kPlanar});
    robot->frames(2);
    EXPECT_TRUE(matte().empty()) << "there is no shape yet";
    session->act(SetShape{shape});
    ASSERT_TRUE(wait([&] { return matte().keyframes.contains(1); }));
    session->act(ApplyTexture{(folder / "tile.png").string(), 0});
    ASSERT_TRUE(wait([&] { return session->view().result_current; }));
    // Refused until the whole shot has been analysed.
    int polls = 0;
    ASSERT_TRUE(wait([&] {
        constexpr int kOften = 100;
        if (polls++ % kOften == 0) session->act(FollowShape{ShapeFollow::kPlanar});
        return !matte().shape.empty();
    }));
    EXPECT_EQ(matte().shape.follow, ShapeFollow::kPlanar);
    EXPECT_TRUE(matte().keyframes.empty());
    ASSERT_EQ(matte().shape.keys.size(), 1u);
    const auto track = read_corner_track(matte().shape.track, {{96, 64}, 1, true});
    ASSERT_TRUE(track) << track.error().text();
    EXPECT_EQ(track->size(), session->view().plate.frames.size());
    // The card pans to the right.
    session->act(GoToFrame{3});
    ASSERT_TRUE(wait([&] {
        return session->view().frame == 3 && session->view().shape &&
               session->view().shape->points[0].at.x > 26.5f;
    }));
    const float moved = session->view().shape->points[0].at.x - 26;
    EXPECT_NEAR(moved, session->view().shape->points[2].at.x - 62, 1.0f);
    // Another way to follow keeps the track.
    session->act(FollowShape{ShapeFollow::kPosition});
    robot->frames(2);
    EXPECT_EQ(matte().shape.follow, ShapeFollow::kPosition);
    EXPECT_FALSE(matte().shape.track.empty());
}

TEST_F(EditorSession, TheStripShowsVariantsAndOneIsChosen) {
    open();
    paint();
    session->act(ApplyTexture{(folder / "tile.png").string(), 0});
    ASSERT_TRUE(wait([&] { return session->view().result_current; }))
        << session->view().preview.error;
    set_workspace(shell->state(), Workspace::kLight);
    shell->state().strip = StripKind::kLight;
    ASSERT_TRUE(wait([&] {
        const auto& cards = session->view().strip.cards;
        return cards.size() == 4 && std::all_of(cards.begin(), cards.end(), [](const StripCard& c) {
                   return c.picture != nullptr;
               });
    })) <<
        [&] {
            std::string text;
            for (const StripCard& c : session->view().strip.cards)
                text += c.label + (c.picture ? " made; " : " waits " + c.error + "; ");
            return text + (session->view().result_current ? "current" : "not current") +
                   (session->view().preview.analysing ? ", analysing" : "");
        }();
    session->act(ChooseFromStrip{1});
    robot->frames(2);
    EXPECT_DOUBLE_EQ(project().regions.back()->light.strength, 0.35);
    robot->key("Ctrl+Z");
    robot->frames(2);
    EXPECT_DOUBLE_EQ(project().regions.back()->light.strength, 1);
    // As a contact sheet: five kinds of seams on each of the four frames.
    shell->state().strip = StripKind::kSeams;
    shell->state().strip_over_time = true;
    ASSERT_TRUE(wait([&] {
        const StripView& strip = session->view().strip;
        return strip.columns == 4 && strip.cards.size() == 20 &&
               std::all_of(strip.cards.begin(), strip.cards.end(),
                           [](const StripCard& c) { return c.picture != nullptr; });
    })) << session->view().strip.cards.size();
    const auto& sheet = session->view().strip.cards;
    EXPECT_EQ(sheet[3].frame, 4);
    EXPECT_TRUE(sheet[0].current);
    EXPECT_FALSE(sheet[4].current);
    EXPECT_EQ(sheet[4].label, "Dynamic programming");
    EXPECT_EQ(sheet[16].label, "Overlap 54 px");
    // A marked range has frames of its own.
    session->act(MarkRange{2, 3});
    ASSERT_TRUE(wait([&] { return session->view().strip.columns == 2; }));
    EXPECT_EQ(sheet[0].frame, 2);
    EXPECT_EQ(sheet[1].frame, 3);
    session->act(MarkRange{});
    ASSERT_TRUE(wait([&] { return session->view().strip.columns == 4; }));
    session->act(ChooseFromStrip{16});
    robot->frames(2);
    EXPECT_EQ(project().regions.back()->synthesis.overlap_px, 54);
    set_workspace(shell->state(), Workspace::kMask);
    robot->frames(3);
    EXPECT_TRUE(session->view().strip.cards.empty());
}

}  // namespace
}  // namespace weft::test
