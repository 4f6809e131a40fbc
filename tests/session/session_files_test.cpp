// Where a project and its files go.
#include <fstream>

#include "app/project/codec/project_file.h"
#include "app/session/document/collect_run.h"
#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class SessionFiles : public SessionByActions {
  protected:
    void save_as(const std::string& name) {
        act(SaveAs{in(name)});
        session_->flush();
        update();
    }
    [[nodiscard]] std::string matte() const { return region().matte->keyframes.at(1).path; }
    [[nodiscard]] std::string last_notice() const {
        return view().notices.empty() ? "" : view().notices.back().text;
    }
};

TEST_F(SessionFiles, AProjectIsNeverSavedAmongThePlatesFrames) {
    open();
    save_as("frames/shot.weft");
    EXPECT_FALSE(fs::exists(in("frames/shot.weft")));
    EXPECT_EQ(view().path, "");
    EXPECT_THAT(last_notice(), HasSubstr("holds the plate's frames"));
    save_as("shot.weft");
    EXPECT_EQ(view().path, in("shot.weft"));
}

TEST_F(SessionFiles, TitleAndRendersFollowTheSavedName) {
    open();
    EXPECT_EQ(view().title, folder_.filename().string()) << "not 'frames', as every shot's folder";
    EXPECT_THAT(view().render_folder, HasSubstr("/weft/" + folder_.filename().string()));
    save_as("one.weft");
    EXPECT_EQ(view().title, "one");
    EXPECT_EQ(view().render_folder, in("one_render_v001"));
    save_as("two.weft");
    EXPECT_EQ(view().render_folder, in("two_render_v001"));
}

TEST_F(SessionFiles, AShotIsNamedByWhatTellsWhichItIs) {
    for (const auto& [folder, file] : {std::pair{"bedroom", "p."}, std::pair{"sh_020", "sh_plate_"},
                                       std::pair{"arch/exr", ""}}) {
        fs::create_directories(in(folder));
        write_shot("of");
        for (int k = 1; k <= 4; ++k)
            fs::rename(in("of/000" + std::to_string(k) + ".png"),
                       in(folder + ("/" + (file + ("000" + std::to_string(k) + ".png")))));
    }
    open();
    const auto title = [&](const std::string& path) {
        act(OpenAny{in(path)});
        update();
        return view().title;
    };
    EXPECT_EQ(title("bedroom/p.####.png"), "bedroom") << "'p' says nothing";
    EXPECT_EQ(title("bedroom/p.0002.png"), "bedroom");
    EXPECT_EQ(title("bedroom"), "bedroom");
    EXPECT_EQ(title("sh_020/sh_plate_####.png"), "sh_plate");
    EXPECT_EQ(title("sh_020"), "sh_020");
    EXPECT_EQ(title("arch/exr/####.png"), "arch");
    fs::copy(in("bedroom"), in("b"), fs::copy_options::recursive);
    EXPECT_EQ(title("b/p.####.png"), "b");
}

TEST_F(SessionFiles, AFrameOpensItsSequenceAtThatFrameAndAnotherShotBeginsAtItsFirst) {
    write_shot("other");
    open();
    act(OpenAny{in("frames/0003.png")});
    ASSERT_TRUE(wait([&] { return view().plate.frames.size() == 4; }));
    update();
    EXPECT_EQ(view().frame, 3);
    act(OpenAny{in("other/####.png")});
    ASSERT_TRUE(wait([&] { return view().plate.frames.size() == 4 && view().plate_picture; }));
    update();
    EXPECT_EQ(view().frame, 1);
}

TEST_F(SessionFiles, AShotThatIsRecoveredRendersUnderItsName) {
    open();
    const std::string kept = in("state/recovery/recovery-" + std::to_string(getpid()) + ".weft");
    ASSERT_TRUE(wait([&] { return fs::exists(kept); }));
    // As if the process had gone: no process has this number.
    fs::copy_file(kept, in("state/recovery/recovery-99999999.weft"));
    session_.reset();
    SessionOptions options;
    options.program = "/bin/false";
    options.state_folder = in("state");
    options.cache.folder = in("cache");
    options.trust_file = in("trusted.json");
    options.offer_recovery = true;
    session_ = std::make_unique<Session>(options);
    update();
    ASSERT_TRUE(view().recovery);
    act(Recover{true});
    update();
    EXPECT_EQ(view().title, folder_.filename().string());
    EXPECT_THAT(view().render_folder, HasSubstr("/weft/" + folder_.filename().string()));
}

TEST_F(SessionFiles, SaveAsTakesMattesAlongAndUndoFindsThem) {
    open();
    paint();
    save_as("one.weft");
    EXPECT_THAT(matte(), testing::StartsWith("one_mattes/"));
    ASSERT_TRUE(wait([&] { return view().mattes.at(0).keep != nullptr; }));
    act(BeginStroke{pen(), {70, 20}, 1});
    act(EndStroke{});
    update();
    save_as("elsewhere/two.weft");
    EXPECT_THAT(matte(), testing::StartsWith("two_mattes/"));
    EXPECT_TRUE(fs::exists(in("elsewhere/" + matte())));
    const auto one = load_project(in("one.weft"));
    ASSERT_TRUE(one);
    EXPECT_TRUE(fs::exists(in(one->regions[0]->matte->keyframes.at(1).path)));
    act(Undo{});
    update();
    const std::string before = matte();
    EXPECT_TRUE(fs::exists(before.starts_with('/') ? before : in("elsewhere/" + before)))
        << before << ": the stroke before, from the new place";
}

TEST_F(SessionFiles, VersionsAreCounted) {
    open();
    act(SaveVersion{});
    update();
    EXPECT_EQ(view().path, "");
    save_as("shot.weft");
    act(SaveVersion{});
    session_->flush();
    update();
    EXPECT_EQ(view().path, in("shot_v002.weft"));
    std::ofstream(in("shot_v003.weft")) << "another artist's";
    act(SaveVersion{});
    session_->flush();
    update();
    EXPECT_EQ(view().path, in("shot_v004.weft"));
}

// The range was marked before the project had a file, and is marked again when that is opened.
TEST_F(SessionFiles, AProjectsMarkedRangeIsRemembered) {
    open();
    act(MarkRange{2, std::nullopt});
    save_as("shot.weft");
    update();
    save_as("other.weft");
    act(MarkRange{});
    update();
    act(OpenProject{in("shot.weft")});
    update();
    EXPECT_EQ(view().mark_in, 2);
    EXPECT_FALSE(view().mark_out);
    act(OpenProject{in("other.weft")});
    update();
    EXPECT_FALSE(view().mark_in);
}

TEST_F(SessionFiles, AProjectOpensAtTheFrameAtWhichItWasLeft) {
    open();
    save_as("shot.weft");
    act(GoToFrame{3});
    update();
    save_as("other.weft");
    act(GoToFrame{1});
    update();
    const auto opens_at = [&](const std::string& what, int frame) {
        act(OpenAny{in(what)});
        update();
        ASSERT_TRUE(wait([&] { return view().plate.state == PlateView::State::kOpen; }));
        EXPECT_EQ(view().frame, frame) << what;
    };
    opens_at("shot.weft", 3);
    opens_at("other.weft", 1);
    opens_at("shot.weft", 3);
    opens_at("frames", 1);
    opens_at("shot.weft", 3);
}

TEST_F(SessionFiles, MissingFilesAreListedAndRelinkedInOneStep) {
    open();
    paint();
    act(ApplyTexture{in("tile.png"), 0});
    save_as("shot.weft");
    fs::create_directories(in("moved"));
    fs::rename(in("tile.png"), in("moved/tile.png"));
    act(OpenProject{in("shot.weft")});
    session_->flush();
    update();
    ASSERT_EQ(view().missing.size(), 1u);
    EXPECT_THAT(view().missing[0], EndsWith("tile.png"));
    act(RelinkFiles{in("moved")});
    session_->flush();
    update();
    EXPECT_TRUE(view().missing.empty());
    EXPECT_EQ(region().texture.sample, "moved/tile.png");
    act(Undo{});
    update();
    EXPECT_EQ(region().texture.sample, "tile.png");
}

TEST_F(SessionFiles, CollectCopiesPlateMattesAndTextures) {
    open();
    paint();
    act(ApplyTexture{in("tile.png"), 0});
    save_as("shot.weft");
    act(CollectProject{in("archive")});
    session_->flush();
    update();
    EXPECT_TRUE(fs::exists(in("archive/shot/shot.weft"))) << last_notice();
    const auto collected = load_project(in("archive/shot/shot.weft"));
    ASSERT_TRUE(collected);
    EXPECT_THAT(collected->plate.path, EndsWith("frames/####.png"));
    EXPECT_TRUE(fs::exists(in("archive/shot/" + collected->regions[0]->texture.sample)));
}

TEST_F(SessionFiles, CollectingIsShownAndGivenUpOnClosing) {
    open();
    save_as("shot.weft");
    act(CollectProject{in("archive")});
    session_->update(1);
    ASSERT_TRUE(view().collecting);
    EXPECT_EQ(view().collecting->folder, in("archive/shot"));
    act(CancelCollect{});
    session_->flush();
    update();
    EXPECT_FALSE(view().collecting);
    // It may have ended before it was cancelled; what is there is whole then.
    EXPECT_EQ(fs::exists(in("archive/shot/files")), fs::exists(in("archive/shot/shot.weft")));
}

TEST(CollectRun, CopiesShareTheirCounts) {
    const CollectRun run("/archive/shot");
    const CollectRun copy = run;
    copy.note({WorkStage::kCollect, 3, 7, 0, 0});
    copy.cancel.cancel();
    EXPECT_EQ(run.done(), 3);
    EXPECT_EQ(run.total(), 7);
    EXPECT_TRUE(run.cancel.cancelled());
}

// Scribbles drawn faster than mattes are found.
TEST_F(SessionFiles, AScribbleDuringTheOneBeforeCounts) {
    open();
    act(ScribbleSelect{{{{30, 30}, {40, 34}}}, {}});
    act(ScribbleSelect{{{{30, 30}, {40, 34}}}, {{{4, 4}, {90, 4}}}});
    ASSERT_TRUE(wait([&] { return view().history.size() == 4; }))
        << "a region and both scribbles: " << view().history.size();
}

}  // namespace
}  // namespace weft::test
