// A job may be cancelled at any point: nothing half written stays, and it can be resumed.
#include <vector>

#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;

using Cancel = ShotTest;

// Cancels when the `at`-th event of a stage has come.
Expected<JobResult> run_until(const JobSpec& job, WorkStage stage, int at, int exit) {
    const CancelToken cancel;
    int seen = 0;
    return run_job(job, cancel, [&](const ProgressEvent& event) {
        if (event.stage == stage && ++seen == at) cancel.cancel(exit);
    });
}

TEST_F(Cancel, BeforeTheFirstFrame) {
    const CancelToken cancel;
    cancel.cancel(130);
    const auto result = run_job(spec("out"), cancel, {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
    EXPECT_THAT(contents("out"), IsEmpty());
}

TEST_F(Cancel, AtAnyPointAndResumed) {
    ASSERT_TRUE(run_job(spec("whole"), {}, {}));
    const auto whole = contents("whole");
    ASSERT_EQ(whole.size(), static_cast<std::size_t>(kFrames));
    const std::pair<WorkStage, int> points[]{{WorkStage::kAnalyse, 1},
                                             {WorkStage::kAnalyse, kFrames / 2},
                                             {WorkStage::kRender, 1},
                                             {WorkStage::kRender, kFrames / 2}};
    for (const auto& [stage, at] : points) {
        SCOPED_TRACE(std::string(name_of(stage)) + " " + std::to_string(at));
        const std::string out = std::string(name_of(stage)) + std::to_string(at);
        JobSpec job = spec(out);
        job.threads = 1;
        job.cache.folder = in("cache." + out);
        const auto stopped = run_until(job, stage, at, 143);
        ASSERT_FALSE(stopped);
        EXPECT_EQ(stopped.error().code, ErrorCode::kTerminated);
        const auto part = contents(out);
        EXPECT_LT(part.size(), whole.size());
        for (const auto& [name, hash] : part)
            EXPECT_EQ(hash, whole.at(name)) << name;
        job.existing = ExistingFrames::kSkip;
        const auto resumed = run_job(job, {}, {});
        ASSERT_TRUE(resumed) << resumed.error().text();
        EXPECT_EQ(contents(out), whole);
    }
}

// Between two references the coordinates of a frame are kept twice: as the first found them, and as
// both agree. A run that stops between the two must not take the first for the last.
TEST_F(Cancel, BetweenTwoReferences) {
    const std::vector<int> orders[]{{1, kFrames}, {3, 1, kFrames}};
    for (const std::vector<int>& references : orders) {
        const std::string name = "from" + std::to_string(references[0]);
        const auto anchored = [&](const std::string& out) {
            JobSpec job = spec(out);
            Region region = *job.project.regions[0];
            region.reference_frames = references;
            job.project.regions[0] = region;
            job.cache.folder = in("cache." + out);
            return job;
        };
        ASSERT_TRUE(run_job(anchored(name), {}, {}));
        const auto whole = contents(name);
        for (const int at : {kFrames, kFrames + 2, kFrames + 4}) {
            SCOPED_TRACE(name + ", stopped at " + std::to_string(at));
            const std::string out = name + "." + std::to_string(at);
            JobSpec job = anchored(out);
            ASSERT_FALSE(run_until(job, WorkStage::kAnalyse, at, 143));
            job.existing = ExistingFrames::kSkip;
            ASSERT_TRUE(run_job(job, {}, {}));
            EXPECT_EQ(contents(out), whole);
        }
    }
}

// The analysis of a part of the shot is no hindrance for the whole.
TEST_F(Cancel, APartialAnalysisIsCompleted) {
    ASSERT_TRUE(run_job(spec("whole"), {}, {}));
    for (const char* frames : {"1-2", "4", "1-6"}) {
        JobSpec job = spec("parts");
        job.project.settings.frames = frames;
        job.existing = ExistingFrames::kSkip;
        job.cache.folder = in("other-cache");
        ASSERT_TRUE(run_job(job, {}, {}));
    }
    EXPECT_EQ(contents("parts"), contents("whole"));
}

TEST_F(Cancel, AfterTheLastFrameIsTooLate) {
    JobSpec job = spec("out");
    job.threads = 1;
    EXPECT_TRUE(run_until(job, WorkStage::kRender, kFrames, 143));
    EXPECT_EQ(contents("out").size(), static_cast<std::size_t>(kFrames));
}

}  // namespace
}  // namespace weft::test
