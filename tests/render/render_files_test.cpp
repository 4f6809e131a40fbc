// The files around a render: the cache's, the layers', the farm's, the recipe's.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "app/cache/analysis_cache.h"
#include "app/cache/blob_file.h"
#include "app/cache/stage_cache.h"
#include "app/farm/farm.h"
#include "app/farm/farm_engines.h"
#include "app/render/burn_in.h"
#include "app/render/existing_frames.h"
#include "app/render/layer_files.h"
#include "app/render/recipe.h"
#include "app/render/report.h"
#include "app/render/version_up.h"
#include "engine/media/atomic_file.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class RenderFiles : public ShotTest {};

TEST_F(RenderFiles, ABlobComesBackWholeOrNotAtAll) {
    Bytes bytes(10'000);
    for (std::size_t k = 0; k < bytes.size(); ++k)
        bytes[k] = static_cast<std::uint8_t>(k * k >> 3);
    const std::string path = in("a.blob");
    ASSERT_TRUE(write_blob(path, bytes));
    EXPECT_LT(std::filesystem::file_size(path), bytes.size());
    EXPECT_EQ(read_blob(path), bytes);
    EXPECT_FALSE(read_blob(in("none.blob")));
    const auto size = std::filesystem::file_size(path);
    {
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(size / 2));
        file.put('\x55').put('\x55');
    }
    EXPECT_FALSE(read_blob(path)) << "a damaged one is none";
    ASSERT_TRUE(write_blob(path, bytes));
    std::filesystem::resize_file(path, size - 1);
    EXPECT_FALSE(read_blob(path)) << "nor is one that is cut off";
}

TEST_F(RenderFiles, MotionAndPlanesAreKeptFromRunToRun) {
    const auto shot = open_shot(spec("out").project);
    ASSERT_TRUE(shot) << shot.error().text();
    const auto store = open_stage_cache(**shot, in("stages"));
    ASSERT_TRUE(store);
    EXPECT_FALSE(store->motion(2, 1));
    FlowField motion;
    motion.d = Image<float, 2>(160, 120);
    motion.d.pixel(3, 4)[0] = 1.25f;
    motion.valid = Image<std::uint8_t, 1>(160, 120, 255);
    store->keep_motion(2, 1, motion);
    const auto again = open_stage_cache(**shot, in("stages"));
    ASSERT_TRUE(again);
    const auto kept = again->motion(2, 1);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->d, motion.d);
    EXPECT_FALSE(again->motion(3, 2));
}

// The caches of planes and motion are shared by runs, so each that opens them tidies up.
TEST_F(RenderFiles, WhatAKilledRunLeftInTheCacheIsRemoved) {
    const auto shot = open_shot(spec("out").project);
    ASSERT_TRUE(shot) << shot.error().text();
    FlowField motion(Size{16, 12});
    open_stage_cache(**shot, in("stages"))->keep_motion(2, 1, motion);
    const std::filesystem::path planes = in("stages/planes");
    std::filesystem::create_directories(planes);
    const pid_t child = fork();
    if (child == 0) {
        auto temporary = TemporaryFile::create((planes / "plane").string(), WriteRule::own());
        raise(SIGKILL);
        _exit(temporary ? 0 : 1);
    }
    waitpid(child, nullptr, 0);
    ASSERT_FALSE(std::filesystem::is_empty(planes));
    const auto again = open_stage_cache(**shot, in("stages"));
    EXPECT_TRUE(std::filesystem::is_empty(planes));
    EXPECT_TRUE(again->motion(2, 1));
}

TEST(BurnIn, WritesOnADarkBandInTheCorner) {
    ImageF3 picture(320, 240, 0.5f);
    const ImageF3 before = picture;
    burn_in(picture, "shot 0012");
    float brightest = 0;
    int changed = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
            if (picture.pixel(x, y)[0] == before.pixel(x, y)[0]) continue;
            ++changed;
            brightest = std::max(brightest, picture.pixel(x, y)[0]);
            EXPECT_GT(y, 200);
        }
    EXPECT_GT(changed, 100);
    EXPECT_GT(brightest, 0.9f);
}

TEST(LayerFiles, EachLayerHasItsChannels) {
    const FrameLayers layers({8, 4});
    const auto exr = exr_layers(layers, {LayerKind::kPatch, LayerKind::kId});
    ASSERT_EQ(exr.size(), 2u);
    EXPECT_EQ(exr[0].channels.size(), 4u);
    EXPECT_EQ(exr[0].samples.size(), 8u * 4 * 4);
    EXPECT_TRUE(exr[1].full_float);
}

TEST(LayerFiles, TheFormHasTheChannelsOfNuke) {
    const FrameLayers layers({8, 4}, true);
    const auto exr =
        exr_layers(layers, {LayerKind::kNormal, LayerKind::kDepth, LayerKind::kFormConfidence});
    ASSERT_EQ(exr.size(), 3u);
    const std::vector<std::string> normal{"normal.x", "normal.y", "normal.z"};
    EXPECT_EQ(exr[0].channels, normal);
    EXPECT_EQ(exr[1].channels, std::vector<std::string>{"depth.Z"});
    EXPECT_TRUE(exr[1].full_float);
    EXPECT_EQ(exr[2].channels, std::vector<std::string>{"form_confidence.A"});
    EXPECT_EQ(exr[2].samples.size(), 8u * 4);
}

TEST_F(RenderFiles, AVersionGoesUpOnlyWhereThereIsOne) {
    EXPECT_EQ(version_in("a/shot_v003.####.exr"), 3);
    EXPECT_EQ(version_in("v002/shot_v010/x.png"), 10);
    EXPECT_FALSE(version_in("shot.####.exr"));
    EXPECT_FALSE(version_in("overv3iew.png"));
    Project project;
    project.output.path = in("shot_v003/####.png");
    EXPECT_EQ(version_up(project)->output.path, project.output.path) << "nothing is there yet";
    std::filesystem::create_directories(in("shot_v003"));
    std::ofstream(in("shot_v003/0001.png")) << "x";
    EXPECT_EQ(version_up(project)->output.path, in("shot_v004/####.png"));
    project.output.path = in("out/####.png");
    EXPECT_EQ(version_up(project).error().code, ErrorCode::kUsage);
}

TEST_F(RenderFiles, ExistingFramesAreRefusedByDefault) {
    const auto pattern = SequencePattern::parse(in("frames/####.png"));
    const auto keep = [&](ExistingFrames existing) {
        return frames_to_keep(*pattern, {2, 3, 40}, Card::kPlate, existing, {{}, {}});
    };
    const auto refused = keep(ExistingFrames::kRefuse);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
    EXPECT_THAT(refused.error().text(), HasSubstr("0002.png"));
    EXPECT_TRUE(keep(ExistingFrames::kOverwrite)->frames.empty());
    const auto resumed = keep(ExistingFrames::kResume);
    ASSERT_FALSE(resumed) << "they carry no recipe";
    EXPECT_THAT(resumed.error().text(), HasSubstr("0002.png was not rendered by Weft"));
}

TEST_F(RenderFiles, AFarmJobSaysWhatEachTaskRuns) {
    const auto shot = open_shot(spec("out").project);
    ASSERT_TRUE(shot);
    const std::vector<FarmStage> stages = farm_stages(**shot, 4);
    ASSERT_FALSE(stages.empty());
    const FarmStage* frames = nullptr;
    for (const FarmStage& stage : stages)
        if (stage.name == "frames") frames = &stage;
    ASSERT_NE(frames, nullptr);
    EXPECT_THAT(frames->frames, ElementsAre("1-4", "5-6"));
    for (const FarmEngine engine : {FarmEngine::kOpenJd, FarmEngine::kSlurm, FarmEngine::kDeadline,
                                    FarmEngine::kOpenCue, FarmEngine::kFlamenco})
        EXPECT_FALSE(engine_files(engine, {"shot", "/a/job.json", stages}).empty());
}

TEST_F(RenderFiles, TheSettingsHashCoversWhatAffectsPixels) {
    JobSpec job = spec("out");
    const auto hash = [&] { return settings_hash(**open_shot(job.project)); };
    const std::string before = hash();
    EXPECT_EQ(before.size(), 32u);
    job.project.output.path = in("elsewhere/####.png");
    job.project.settings.frames = "2-3";
    EXPECT_EQ(hash(), before);
    job.project.settings.seed = 7;
    EXPECT_NE(hash(), before);
    EXPECT_STRNE(kVersion, "");
}

}  // namespace
}  // namespace weft::test
