// Render requests, and reports of finished jobs.
#include "app/session/jobs/job_desk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/jobs/job_record.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

Project project() {
    Project out;
    out.name = "Shot 7";
    out.plate.path = "/shot/####.png";
    out.output.movie = "/elsewhere.mp4";
    return out;
}

TEST(RenderRequest, TakesTheActionsOutputAndFrames) {
    SubmitJob action;
    action.output = "out/####.exr";
    action.frames = "3-5";
    action.layers = {LayerKind::kPatch};
    action.skip_existing = true;
    action.estimated_s = 12;
    const auto request = render_request(action, project(), {1, 2, 3, 4, 5, 6});
    ASSERT_TRUE(request);
    EXPECT_THAT(request->frames, ElementsAre(3, 4, 5));
    EXPECT_EQ(request->label, "Shot 7, frames 3-5");
    EXPECT_TRUE(fs::path(request->project.output.path).is_absolute());
    EXPECT_THAT(request->project.output.path, EndsWith("/out/####.exr"));
    EXPECT_EQ(request->project.output.movie, "") << "the action says none";
    EXPECT_EQ(request->project.output.layers_path, "");
    EXPECT_THAT(request->project.output.layers, ElementsAre(LayerKind::kPatch));
    EXPECT_EQ(request->estimated_s, 0) << "nobody knows what is there already";
}

TEST(RenderRequest, TakesAllFramesWhereNoneAreNamed) {
    SubmitJob action;
    action.output = "/out/####.png";
    const auto request = render_request(action, Project{}, {7, 8});
    ASSERT_TRUE(request);
    EXPECT_THAT(request->frames, ElementsAre(7, 8));
    EXPECT_THAT(request->label, HasSubstr("Shot, frames 7-8"));
    action.frames = "seven";
    EXPECT_FALSE(render_request(action, Project{}, {7, 8}));
}

TEST(JobDesk, ReportsTheEndOfAJobOnce) {
    const fs::path folder =
        fs::temp_directory_path() / ("weft_job_desk_" + std::to_string(getpid()));
    {
        JobDesk desk("/bin/false", folder.string());
        EXPECT_TRUE(desk.poll({}, {}).empty());
        SubmitJob action;
        action.output = (folder / "out" / "####.png").string();
        const auto request = render_request(action, project(), {1, 2});
        ASSERT_TRUE(request);
        ASSERT_TRUE(desk.submit(*request));
        std::vector<JobDesk::Ended> ended;
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (ended.empty() && std::chrono::steady_clock::now() < end) {
            ended = desk.poll({}, {});
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        ASSERT_EQ(ended.size(), 1u);
        EXPECT_TRUE(ended[0].failed);
        EXPECT_EQ(ended[0].label, request->label);
        EXPECT_TRUE(desk.poll({}, {}).empty()) << "it was said";
        ASSERT_EQ(desk.jobs().size(), 1u);
        desk.command({desk.jobs()[0].id, JobCommand::kRemove});
        while (!desk.jobs().empty() && std::chrono::steady_clock::now() < end)
            EXPECT_TRUE(desk.poll({}, {}).empty());
        EXPECT_TRUE(desk.jobs().empty());
    }
    fs::remove_all(folder);
}

// Also of one that was over before the window was opened.
TEST(JobDesk, ComparesTheTimeOfAJobWithItsEstimateOnce) {
    const fs::path folder =
        fs::temp_directory_path() / ("weft_job_times_" + std::to_string(getpid()));
    fs::create_directories(folder);
    JobRecord record;
    record.name = "job_1";
    record.state = JobState::kDone;
    record.estimated_s = 100;
    record.elapsed_s = 25;
    ASSERT_TRUE(write_job(folder.string(), record));
    const auto timed = [&](std::chrono::milliseconds patience) {
        JobDesk desk("/bin/false", folder.string());
        std::vector<JobDesk::Timed> out;
        const auto end = std::chrono::steady_clock::now() + patience;
        while (out.empty() && std::chrono::steady_clock::now() < end) {
            EXPECT_TRUE(desk.poll({}, {}).empty());
            out = desk.take_timed();
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        EXPECT_TRUE(desk.poll({}, {}).empty());
        EXPECT_TRUE(desk.take_timed().empty());
        return out;
    };
    const auto first = timed(std::chrono::minutes(1));
    ASSERT_EQ(first.size(), 1u);
    EXPECT_EQ(first[0].estimated_s, 100);
    EXPECT_EQ(first[0].took_s, 25);
    EXPECT_TRUE(timed(std::chrono::milliseconds(300)).empty()) << "in the next run";
    fs::remove_all(folder);
}

}  // namespace
}  // namespace weft::test
