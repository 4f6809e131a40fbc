// The queue of renders outlives its window, and several windows share it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "app/jobs/child_jobs.h"
#include "app/jobs/job_answer.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

// A renderer that waits for a file "go" and ends as a file "answer" says, else well. It notes when
// it begins and ends.
constexpr const char* kRenderer = R"(#!/bin/sh
here=$(dirname "$0")
echo "begin" >> "$here/log"
echo '{"stage":"render","frame":1,"done":1,"total":2}'
while [ ! -e "$here/go" ]; do sleep 0.01; done
echo "end" >> "$here/log"
if [ -e "$here/answer" ]; then cp "$here/answer" "$WEFT_ANSWER_FILE"; exit 3; fi
echo '{"exit_code": 0}' > "$WEFT_ANSWER_FILE"
)";

class JobQueue : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("weft_job_queue_" + std::to_string(getpid()));
        fs::create_directories(folder_);
        write("renderer", kRenderer);
        fs::permissions(in("renderer"), fs::perms::owner_all);
    }
    void TearDown() override {
        write("go", "");
        for (auto& window : windows_)
            if (window) static_cast<void>(wait(*window, [&] { return !window->busy(); }));
        windows_.clear();
        fs::remove_all(folder_);
    }
    [[nodiscard]] std::string in(const std::string& name) const {
        return (folder_ / name).string();
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(in(name)) << text;
    }
    ChildJobs& window() {
        windows_.push_back(std::make_unique<ChildJobs>(in("renderer"), in("jobs")));
        return *windows_.back();
    }
    static void close(std::unique_ptr<ChildJobs>& window) { window.reset(); }
    int submit(ChildJobs& window, const std::string& label) {
        RenderRequest request;
        request.label = label;
        request.project_file = in("shot.weft");
        request.project.plate.path = in("plate.####.png");
        request.project.output.path = in("out.####.png");
        Region wall;
        wall.name = "wall";
        request.project.regions.push_back(wall);
        request.frames = {1, 2};
        const auto id = window.submit(request);
        EXPECT_TRUE(id) << id.error().text();
        return id.value_or(0);
    }
    template <class Done>
    static bool wait(ChildJobs&, Done&& done) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!done()) {
            if (std::chrono::steady_clock::now() > end) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return true;
    }
    static std::vector<std::string> labels(const ChildJobs& window, JobState state) {
        std::vector<std::string> out;
        for (const JobView& job : window.views())
            if (job.state == state) out.push_back(job.label);
        return out;
    }
    static JobView only(const ChildJobs& window) {
        const auto views = window.views();
        EXPECT_EQ(views.size(), 1u);
        return views.empty() ? JobView{} : views[0];
    }
    [[nodiscard]] std::vector<std::string> log() const {
        std::ifstream file(in("log"));
        std::vector<std::string> out;
        for (std::string line; std::getline(file, line);)
            out.push_back(line);
        return out;
    }

    fs::path folder_;
    std::vector<std::unique_ptr<ChildJobs>> windows_;
};

TEST_F(JobQueue, ARenderGoesOnAndIsFoundByTheNextWindow) {
    ChildJobs& first = window();
    submit(first, "a");
    submit(first, "b");
    ASSERT_TRUE(wait(first, [&] { return log().size() == 1; }));
    close(windows_[0]);
    ChildJobs& second = window();
    ASSERT_TRUE(wait(second, [&] { return second.views().size() == 2; }));
    EXPECT_THAT(labels(second, JobState::kRunning), ElementsAre("a"));
    EXPECT_THAT(labels(second, JobState::kWaiting), ElementsAre("b"));
    ASSERT_TRUE(wait(second, [&] { return second.views()[0].has_frame; })) << "its progress";
    EXPECT_FALSE(second.views()[0].mine);
    write("go", "");
    ASSERT_TRUE(wait(second, [&] { return labels(second, JobState::kDone).size() == 2; }));
    EXPECT_THAT(log(), ElementsAre("begin", "end", "begin", "end")) << "each once";
}

TEST_F(JobQueue, AFailureIsThereAfterARestartWithWhatItIsAbout) {
    write("go", "");
    write("answer", R"({"exit_code": 3, "error": {"code": 3,
        "message": "Region 'wall': The matte of frame 2 cannot be read. Paint it ({matte})."}})");
    ChildJobs& first = window();
    submit(first, "a");
    ASSERT_TRUE(wait(first, [&] { return !first.busy(); }));
    close(windows_[0]);
    ChildJobs& second = window();
    ASSERT_TRUE(wait(second, [&] { return !second.views().empty(); }));
    const JobView job = only(second);
    EXPECT_EQ(job.state, JobState::kFailed);
    EXPECT_THAT(job.error, HasSubstr("The matte of frame 2 cannot be read."));
    EXPECT_EQ(job.problem.frame, 2);
    EXPECT_EQ(job.problem.region, "wall");
    EXPECT_EQ(job.problem.setting, "matte");
    EXPECT_EQ(job.project, in("shot.weft"));
    EXPECT_TRUE(job.earlier) << "not to be announced again";
    second.remove(job.id);
    ASSERT_TRUE(wait(second, [&] { return second.views().empty(); }));
    for (const auto& entry : fs::directory_iterator(in("jobs")))
        EXPECT_EQ(entry.path().filename(), "queue.lock") << "nothing of it stays";
}

TEST_F(JobQueue, TwoWindowsShareOneQueueAndRenderOneAfterTheOther) {
    ChildJobs &first = window(), &second = window();
    submit(first, "a");
    submit(second, "b");
    submit(first, "c");
    ASSERT_TRUE(wait(second, [&] {
        return first.views().size() == 3 && second.views().size() == 3 && log().size() == 1;
    }));
    write("go", "");
    ASSERT_TRUE(wait(first, [&] { return labels(first, JobState::kDone).size() == 3; }));
    ASSERT_TRUE(wait(second, [&] { return labels(second, JobState::kDone).size() == 3; }));
    EXPECT_THAT(log(), ElementsAre("begin", "end", "begin", "end", "begin", "end"));
}

TEST_F(JobQueue, WhatWaitsCanBeReordered) {
    ChildJobs &first = window(), &second = window();
    submit(first, "a");
    ASSERT_TRUE(wait(first, [&] { return log().size() == 1; }));
    submit(first, "b");
    const int c = submit(first, "c");
    first.move(c, -1);
    ASSERT_TRUE(wait(second, [&] {
        return labels(second, JobState::kWaiting) == std::vector<std::string>{"c", "b"};
    })) << "in the other window, too";
    first.move(c, -1);
    first.move(c, 1);
    ASSERT_TRUE(wait(second, [&] {
        return labels(second, JobState::kWaiting) == std::vector<std::string>{"b", "c"};
    }));
    EXPECT_THAT(labels(first, JobState::kRunning), ElementsAre("a"));
}

TEST_F(JobQueue, ARendererThatWasKilledWhileNoWindowWasOpenHasFailed) {
    ChildJobs& first = window();
    submit(first, "a");
    ASSERT_TRUE(wait(first, [&] { return log().size() == 1; }));
    close(windows_[0]);
    for (const JobRecord& record : read_jobs(in("jobs")))
        ASSERT_TRUE(signal_to(record.process, SIGKILL));
    ChildJobs& second = window();
    ASSERT_TRUE(wait(second, [&] { return labels(second, JobState::kFailed).size() == 1; }));
    EXPECT_THAT(only(second).error, HasSubstr("ended unexpectedly"));
    write("go", "");
    second.retry(only(second).id);
    ASSERT_TRUE(wait(second, [&] { return labels(second, JobState::kDone).size() == 1; }));
}

TEST_F(JobQueue, AnotherWindowPausesAndCancels) {
    ChildJobs &first = window(), &second = window();
    submit(first, "a");
    ASSERT_TRUE(wait(second, [&] { return labels(second, JobState::kRunning).size() == 1; }));
    second.pause(only(second).id);
    ASSERT_TRUE(wait(first, [&] { return labels(first, JobState::kPaused).size() == 1; }));
    second.cancel(only(second).id);
    ASSERT_TRUE(wait(first, [&] { return labels(first, JobState::kCancelled).size() == 1; }));
    EXPECT_TRUE(only(first).error.empty());
}

TEST_F(JobQueue, DamagedRecordsAreLeftOut) {
    fs::create_directories(in("jobs"));
    write("jobs/x.job.json", "{\"schema\": \"weft.queued_job/1\", \"state\": 7");
    write("jobs/y.job.json", R"({"schema": "weft.queued_job/1", "state": "done", "place": "one"})");
    write("jobs/z.job.json", R"({"schema": "weft.queued_job/9", "state": "waiting"})");
    write("go", "");
    ChildJobs& window = this->window();
    submit(window, "a");
    ASSERT_TRUE(wait(window, [&] { return labels(window, JobState::kDone).size() == 1; }));
    EXPECT_EQ(window.views().size(), 1u);
}

TEST(JobAnswer, AFileNamesItsFrame) {
    Project project;
    project.plate.path = "/shot/plate.####.png";
    JobAnswer answer;
    answer.message = "The plate frame /shot/plate.0007.png is damaged.";
    EXPECT_EQ(problem_of(answer, project, {6, 7, 8}).frame, 7);
    EXPECT_FALSE(problem_of(answer, project, {6, 8}).frame) << "not of this job";
    answer.message = "There are 7 frames too many; {run.nothing}.";
    EXPECT_FALSE(problem_of(answer, project, {6, 7, 8}).known());
    answer.field = "settings.frames";
    EXPECT_EQ(problem_of(answer, project, {6}).setting, "settings.frames");
}

}  // namespace
}  // namespace weft::test
