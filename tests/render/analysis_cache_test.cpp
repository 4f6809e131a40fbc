// The analysis is made once, found again by content, and made anew when anything it depends on
// changes.
#include <fstream>

#include "app/render/recipe.h"
#include "app/shot/painted_mattes.h"
#include "engine/media/frame_writer.h"
#include "engine/pipeline/analyse.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class AnalysisCache : public ShotTest {
  protected:
    JobSpec scaled(const std::string& out, double scale) const {
        JobSpec job = spec(out);
        Region region = *job.project.regions[0];
        region.placement.scale = scale;
        job.project.regions[0] = region;
        return job;
    }
    fs::path any_blob() const {
        for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache"))
            if (entry.is_regular_file() && entry.path().filename() == "coords.3") return entry;
        return {};
    }
};

TEST_F(AnalysisCache, FindsTheAnalysisAgainForOtherPlacementsAndLights) {
    EXPECT_GE(analysed_steps(spec("first")), kFrames);
    EXPECT_EQ(analysed_steps(spec("second")), 0);
    EXPECT_EQ(contents("first"), contents("second"));
    EXPECT_EQ(analysed_steps(scaled("scaled", 2)), 0);
    EXPECT_NE(contents("first"), contents("scaled"));
}

TEST_F(AnalysisCache, AChangedFrameOrMatteIsAnalysedAgain) {
    analysed_steps(spec("first"));
    WriteOptions replacing;
    replacing.rule = WriteRule::own();
    const auto time = fs::last_write_time(in("frames/0003.png"));
    fs::last_write_time(in("frames/0003.png"), time + std::chrono::hours(1));
    EXPECT_EQ(analysed_steps(spec("touched")), 0) << "the same bytes are the same frame";
    // A frame of the same size and time, as a copy that keeps times makes it.
    ASSERT_TRUE(write_image(in("frames/0003.png"), card_plate(4), {}, replacing));
    fs::last_write_time(in("frames/0003.png"), time + std::chrono::hours(1));
    EXPECT_GE(analysed_steps(spec("second")), kFrames);
    ASSERT_TRUE(write_matte(in("masks/0005.png"), card_matte(3), replacing.rule));
    EXPECT_GE(analysed_steps(spec("third")), kFrames);
    JobSpec final = spec("final");
    final.project.settings.quality = Quality::kFinal;
    EXPECT_GE(analysed_steps(final), kFrames);
}

// As the editor's preview does it: the analysis begins before the matte is on the disk.
TEST_F(AnalysisCache, AMatteInMemoryIsFoundAgainByItsFile) {
    JobSpec job = spec("out");
    Region region = *job.project.regions[0];
    const Matte matte = card_matte(1);
    MatteSource painted;
    painted.keyframes[1] = {in("painted.png")};
    region.matte = painted;
    region.reference_frames = {1};
    job.project.regions[0] = region;
    const auto absent = open_shot(job.project);
    ASSERT_TRUE(absent) << absent.error().text();
    EXPECT_FALSE((*absent)->source->matte_key(0, 1)) << "it is not on the disk";

    OpenShotOptions options;
    options.painted[in("painted.png")] = std::make_shared<const Matte>(matte);
    const auto shot = open_shot(job.project, options);
    ASSERT_TRUE(shot) << shot.error().text();
    const auto read = (*shot)->source->matte_key(0, 1);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(*read, matte);
    std::vector<std::string> warnings;
    const auto store = open_analysis_cache(**shot, job.cache, warnings);
    ASSERT_TRUE(store) << store.error().text();
    ASSERT_TRUE(analyse_shot(*(*shot)->source, (*shot)->plan, **store, {}, {}));
    (*store)->mattes_written(**shot);
    const AnalysisKey key{0, 3, AnalysisKind::kMatte};
    EXPECT_TRUE((*store)->has(key)) << "it is not written: all stays where it is";

    ASSERT_TRUE(write_matte(in("painted.png"), matte, WriteRule::own()));
    (*store)->mattes_written(**shot);
    EXPECT_TRUE((*store)->has(key)) << "it has moved, and is read from there";
    EXPECT_EQ(analysed_steps(job), 0) << "a render finds it by the file";
}

// The editor takes painted mattes along when it saves a project under another name.
TEST_F(AnalysisCache, APaintedMatteIsFoundAgainByItsContentsWhereverItLies) {
    const auto painted_in = [&](const std::string& file, const std::string& out) {
        JobSpec job = spec(out);
        job.project.regions[0] = job.project.regions[0].with([&](Region& r) {
            MatteSource painted;
            painted.keyframes[1] = {in(file)};
            r.matte = painted;
            r.reference_frames = {1};
        });
        return job;
    };
    ASSERT_TRUE(write_matte(in("first.png"), card_matte(1), WriteRule::own()));
    EXPECT_GE(analysed_steps(painted_in("first.png", "a")), kFrames);
    fs::copy_file(in("first.png"), in("second.png"));
    EXPECT_EQ(analysed_steps(painted_in("second.png", "b")), 0);
    ASSERT_TRUE(write_matte(in("second.png"), card_matte(3), WriteRule::own()));
    EXPECT_GE(analysed_steps(painted_in("second.png", "c")), kFrames);
}

TEST_F(AnalysisCache, ADamagedBlobIsMadeAgain) {
    analysed_steps(spec("first"));
    const fs::path blob = any_blob();
    ASSERT_FALSE(blob.empty());
    for (const bool cut : {true, false}) {
        if (cut) {
            fs::resize_file(blob, fs::file_size(blob) / 2);
        } else {
            std::fstream file(blob, std::ios::in | std::ios::out | std::ios::binary);
            file.seekp(-3, std::ios::end);
            file.put('\x55');
        }
        const std::string out = cut ? "cut" : "flipped";
        EXPECT_GE(analysed_steps(spec(out)), 1) << out;
        EXPECT_EQ(contents(out), contents("first")) << out;
    }
}

// What was found intact is not read again to know that; it is as soon as it is wanted.
TEST_F(AnalysisCache, ABlobThatIsDamagedOrGoneMeanwhileIsMissed) {
    const JobSpec job = spec("out");
    analysed_steps(job);
    const auto shot = open_shot(job.project);
    ASSERT_TRUE(shot) << shot.error().text();
    std::vector<std::string> warnings;
    const auto store = open_analysis_cache(**shot, job.cache, warnings);
    ASSERT_TRUE(store) << store.error().text();
    const AnalysisKey key{0, 3, AnalysisKind::kCoords};
    ASSERT_TRUE((*store)->has(key));
    const auto bytes = (*store)->get(key);
    ASSERT_TRUE(bytes);
    fs::resize_file(any_blob(), fs::file_size(any_blob()) / 2);
    EXPECT_FALSE((*store)->get(key));
    EXPECT_FALSE((*store)->has(key)) << "so it is computed again";
    ASSERT_TRUE((*store)->put(key, *bytes));
    EXPECT_TRUE((*store)->has(key));
    fs::remove(any_blob());
    EXPECT_FALSE((*store)->has(key));
}

// Names that cannot be replaced stand for a disk that is full: nothing can be written there.
TEST_F(AnalysisCache, ACacheThatCannotBeWrittenAnyMoreIsAWarning) {
    analysed_steps(spec("first"));
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache")) {
        if (!entry.is_regular_file()) continue;
        fs::remove(entry.path());
        fs::create_directories(entry.path() / "in the way");
    }
    const auto result = run_job(spec("second"), {}, {});
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_EQ(contents("second"), contents("first"));
    EXPECT_THAT(result->warnings, ElementsAre(HasSubstr("cache folder")));
    // A farm's next stage would find nothing.
    JobSpec stage = spec("third");
    stage.stage = JobStage::kAnalyse;
    const auto failed = run_job(stage, {}, {});
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::kNoSpace);
}

// Frames beyond those that are asked for may be on their way still.
TEST_F(AnalysisCache, FramesThatNobodyNeedsNeedNotBeThere) {
    for (const Quality quality : {Quality::kDraft, Quality::kFinal}) {
        const std::string name = quality == Quality::kDraft ? "draft" : "final";
        SCOPED_TRACE(name);
        JobSpec whole = spec(name + "_whole");
        whole.project.settings.quality = quality;
        whole.project.settings.frames = "1-3";
        for (const char* file : {"frames/0005.png", "masks/0005.png"})
            fs::rename(in(file), in(file) + ".kept");
        const auto without = run_job(whole, {}, {});
        ASSERT_TRUE(without) << without.error().text();
        for (const char* file : {"frames/0005.png", "masks/0005.png"})
            fs::create_symlink("nowhere.png", in(file));
        JobSpec dangling = whole;
        dangling.project.output.path = in(name + "_dangling/####.png");
        const auto result = run_job(dangling, {}, {});
        ASSERT_TRUE(result) << result.error().text();
        EXPECT_EQ(contents(name + "_dangling"), contents(name + "_whole"));
        EXPECT_TRUE(recipe_json(*result->shot, *result));
        for (const char* file : {"frames/0005.png", "masks/0005.png"}) {
            fs::remove(in(file));
            fs::rename(in(file) + ".kept", in(file));
        }
    }
}

TEST_F(AnalysisCache, AFrameThatIsOnlyMeasuredNeedNotBeWhole) {
    JobSpec job = spec("without");
    job.project.settings.quality = Quality::kFinal;
    job.project.settings.frames = "1-3";
    for (const char* file : {"frames/0005.png", "frames/0006.png"})
        fs::rename(in(file), in(file) + ".kept");
    ASSERT_TRUE(run_job(job, {}, {}));
    fs::rename(in("frames/0005.png.kept"), in("frames/0005.png"));
    fs::resize_file(in("frames/0005.png"), fs::file_size(in("frames/0005.png")) / 2);
    job.project.output.path = in("truncated/####.png");
    const auto result = run_job(job, {}, {});
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_EQ(contents("truncated"), contents("without"));
    EXPECT_THAT(result->warnings, ElementsAre(HasSubstr("Frame 5 cannot be read")));
    // Where it is asked for, it is an error.
    job.project.settings.frames = "1-5";
    job.project.output.path = in("asked/####.png");
    const auto asked = run_job(job, {}, {});
    ASSERT_FALSE(asked);
    EXPECT_EQ(asked.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(asked.error().text(), HasSubstr("0005.png"));
}

TEST_F(AnalysisCache, ThePartsOfAShotAreTheWhole) {
    analysed_steps(spec("whole"));
    for (const char* part : {"5-6", "1,3", "2,4"}) {
        JobSpec job = spec("parts");
        job.project.settings.frames = part;
        job.cache.keep = false;
        job.cache.folder.clear();
        analysed_steps(job);
    }
    EXPECT_EQ(contents("parts"), contents("whole"));
}

TEST_F(AnalysisCache, TheLongestUnusedGoesFirst) {
    analysed_steps(spec("first"));
    JobSpec final = spec("final");
    final.project.settings.quality = Quality::kFinal;
    final.cache.limit_bytes = 1;
    analysed_steps(final);
    int analyses = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_ / "cache/analysis"))
        ++analyses;
    EXPECT_EQ(analyses, 3);  // those in use stay: the surface, its form and its focus
    EXPECT_EQ(analysed_steps(spec("again")) > 0, true);
}

}  // namespace
}  // namespace weft::test
