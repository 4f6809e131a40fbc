// The session driven by actions only.
#include <fstream>

#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

TEST_F(SessionByActions, AStrokeIsShownKeptAndUndone) {
    open();
    act(BeginStroke{pen(), {30, 30}, 1});
    session_->act_now({ContinueStroke{{50, 34}, 1}});
    ASSERT_EQ(view().mattes.size(), 1u);
    EXPECT_EQ(view().mattes[0].pixels.at(50, 34), 255) << "within the frame";
    EXPECT_TRUE(view().painting);
    act(EndStroke{});
    update();
    EXPECT_FALSE(view().painting);
    ASSERT_TRUE(region().matte->keyframes.contains(1));
    EXPECT_EQ(view().mattes[0].pixels.at(50, 34), 255) << "before its file is there";
    session_->flush();
    const auto written = read_matte(region().matte->keyframes.at(1).path, {}, {96, 64});
    ASSERT_TRUE(written) << written.error().text();
    EXPECT_EQ(written->at(50, 34), 255);
    EXPECT_EQ(written->at(2, 2), 0);
    act(Undo{});
    update();
    EXPECT_TRUE(region().matte->keyframes.empty());
}

TEST_F(SessionByActions, UndoDropsAMatteThatIsStillWorkedOut) {
    open();
    paint();
    const std::string painted = region().matte->keyframes.at(1).path;
    const int position = view().history_position;
    act(ScribbleSelect{{{{30, 30}, {40, 34}}}, {{{4, 4}, {90, 4}}}});
    act(Undo{});
    update();
    EXPECT_FALSE(view().matte_busy);
    EXPECT_EQ(view().history_position, position) << "the stroke before is still there";
    EXPECT_EQ(region().matte->keyframes.at(1).path, painted);
    act(Undo{});
    update();
    EXPECT_TRUE(region().matte->keyframes.empty());
}

// The preview uses a stroke from memory, even if the disk fails.
TEST_F(SessionByActions, AStrokeIsPreviewedEvenIfItCannotBeWritten) {
    fs::create_directories(folder_ / "state");
    std::ofstream(folder_ / "state" / "unsaved") << "in the place of the folder";
    open();
    paint();
    act(ApplyTexture{in("tile.png"), 0});
    ASSERT_TRUE(wait([&] {
        return view().result_current || view().preview.state == PreviewView::State::kFailed;
    }));
    EXPECT_TRUE(view().result_current) << view().preview.error;
    EXPECT_FALSE(fs::exists(region().matte->keyframes.at(1).path));
    EXPECT_TRUE(std::any_of(view().notices.begin(), view().notices.end(), [](const Notice& n) {
        return n.kind == NoticeKind::kError;
    })) << "and the artist is told";
}

// What was analysed from the matte in memory has the bytes of a render from its file.
TEST_F(SessionByActions, ThePreviewOfAStrokeIsWhatARenderWrites) {
    open();
    paint();
    act(ApplyTexture{in("tile.png"), 0});
    ASSERT_TRUE(wait([&] {
        return view().result_current && !view().stages.approximate && view().stages.proxy == 1;
    })) << view().preview.error;
    session_->flush();
    JobSpec job;
    job.project = view().project;
    job.project.settings.quality = view().preview_quality;
    job.project.output.path = in("out/####.png");
    job.cache.folder = in("cache_of_render");
    job.backend = "cpu";
    const auto done = run_job(job, {}, {});
    ASSERT_TRUE(done) << done.error().text();
    const auto file = read_image(in("out/0001.png"));
    ASSERT_TRUE(file);
    const ImageU8x3& shown = view().stages.stages[static_cast<std::size_t>(Stage::kFinal)]->srgb;
    int different = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 96 * 3; ++x)
            different +=
                shown.row(y)[x] != static_cast<std::uint8_t>(file->rgb.row(y)[x] * 255.0f + 0.5f);
    EXPECT_EQ(different, 0);
}

TEST_F(SessionByActions, TheStripShowsItsCardsAndOneIsChosen) {
    open();
    paint();
    act(ApplyTexture{in("tile.png"), 0});
    act(ShowStrip{StripKind::kLight, {}, false});
    ASSERT_TRUE(wait([&] {
        const auto& cards = view().strip.cards;
        return cards.size() == 4 && std::all_of(cards.begin(), cards.end(), [](const StripCard& c) {
                   return c.picture != nullptr;
               });
    }));
    act(ChooseFromStrip{1});
    update();
    EXPECT_DOUBLE_EQ(region().light.strength, 0.35);
    act(ShowStrip{StripKind::kSeams, {}, true});
    ASSERT_TRUE(wait([&] { return view().strip.columns == 4; }));
    EXPECT_EQ(view().strip.cards.size(), 20u);
    act(MarkRange{2, 3});
    ASSERT_TRUE(wait([&] { return view().strip.columns == 2; }));
    EXPECT_EQ(view().strip.cards[1].frame, 3);
    act(ShowStrip{});
    update();
    EXPECT_TRUE(view().strip.cards.empty());
}

TEST_F(SessionByActions, PlaysStepsAndStops) {
    open();
    ASSERT_TRUE(wait([&] {
        return view().marks.size() == 4 &&
               std::all_of(view().marks.begin(), view().marks.end(),
                           [](const FrameMarks& mark) { return mark.plate; });
    }));
    act(StepFrames{1});
    update();
    EXPECT_EQ(view().frame, 2);
    act(Play{1});
    ASSERT_TRUE(wait([&] { return view().frame == 4; }));
    act(GoToFrame{1});
    update();
    EXPECT_EQ(view().playing, 0);
    EXPECT_EQ(view().frame, 1);
}

TEST_F(SessionByActions, AFailedRenderIsReported) {
    open();
    paint();
    act(ApplyTexture{in("tile.png"), 0});
    SubmitJob job;
    job.output = in("out/####.png");
    act(job);
    ASSERT_TRUE(wait([&] {
        return std::any_of(view().notices.begin(), view().notices.end(),
                           [](const Notice& n) { return n.text.starts_with("Render failed."); });
    }));
    ASSERT_EQ(view().jobs.size(), 1u);
    EXPECT_EQ(view().jobs[0].state, JobState::kFailed);
}

TEST_F(SessionByActions, AScribbleShowsItsMatteWhileItIsDrawn) {
    open();
    const auto shown = [&] {
        const ViewU8x1 pixels = view().mattes.back().pixels;
        return pixels.width() > 0 && pixels.at(44, 32) > 127;
    };
    const ScribbleSelect lines{{{{32, 24}, {56, 40}}}, {{{4, 4}, {90, 6}}, {{4, 60}, {90, 60}}}};
    const std::size_t before = view().history_position;
    act(TryScribble{lines});
    ASSERT_TRUE(wait(shown));
    EXPECT_EQ(view().history_position, before) << "it is only tried";
    EXPECT_TRUE(region().matte->keyframes.empty());
    act(TryScribble{});
    update();
    EXPECT_FALSE(shown()) << "given up";
    act(TryScribble{lines});
    ASSERT_TRUE(wait(shown));
    act(lines);
    ASSERT_TRUE(wait([&] {
        EXPECT_TRUE(shown()) << "it does not flicker";
        return !region().matte->keyframes.empty();
    }));
    act(TryScribble{lines});
    act(GoToFrame{3});
    ASSERT_TRUE(wait([&] { return !session_->busy(); }));
    act(GoToFrame{view().plate.frames.front()});
    act(Undo{});
    ASSERT_TRUE(wait([&] { return region().matte->keyframes.empty(); }));
    update();
    EXPECT_FALSE(shown()) << "nothing is left of what was tried before";
}

// Its strokes would begin a holdout or a zone of it.
TEST_F(SessionByActions, OfANewRegionTheMatteIsPainted) {
    open();
    for (const int layer : {1, -1}) {
        act(SelectMatteLayer{layer});
        update();
        ASSERT_EQ(view().matte_layer, layer);
        Region added;
        added.name = "beside " + std::to_string(layer);
        act(DoEdit{AddRegion{added, {}}});
        update();
        ASSERT_EQ(region().name, added.name);
        EXPECT_EQ(view().matte_layer, 0);
        paint();
        EXPECT_EQ(region().matte->keyframes.size(), 1U);
        EXPECT_TRUE(region().zones->empty());
        EXPECT_TRUE(region().holdouts->empty());
    }
}

// It would be a wrong statement there.
TEST_F(SessionByActions, ARefusalGoesWhenItHoldsNoMore) {
    open();
    act(DoEdit{RemoveRegion{{region().id, {}}}});
    act(FillPolygon{{{30, 30}, {40, 30}, {40, 40}}, true, false});
    update();
    ASSERT_EQ(view().notices.size(), 1U);
    EXPECT_EQ(view().notices[0].text, "Add a region first; then paint its matte.");
    update();
    EXPECT_EQ(view().notices.size(), 1U) << "it stays while it holds";
    Region wall;
    wall.name = "wall";
    act(DoEdit{AddRegion{wall, {}}});
    update();
    EXPECT_TRUE(view().notices.empty());
    act(LockRegion{region().id, true});
    paint();
    ASSERT_EQ(view().notices.size(), 1U);
    act(LockRegion{region().id, false});
    update();
    EXPECT_TRUE(view().notices.empty());
}

}  // namespace
}  // namespace weft::test
