// The queue on the Jobs page: its order, and the way from a failure to what it is about.
#include "app/jobs/job_record.h"
#include "tests/ui/ui_harness.h"
#include "ui/jobs/job_words.h"

namespace weft::test {
namespace {

using ::testing::SizeIs;

class QueuePage : public PanelTest {
  protected:
    void add(JobState state) {
        JobView job = view.jobs[0];
        job.id = static_cast<int>(view.jobs.size()) + 1;
        job.state = state;
        job.plate = view.plate.path;
        view.jobs.push_back(job);
    }
    [[nodiscard]] float top_of(int id) const {
        const DrawnItem* log = robot->find("Job " + std::to_string(id) + "/Log");
        return log ? log->min.y : -1;
    }
    void show() {
        set_workspace(shell->state(), Workspace::kJobs);
        robot->frames(3);
    }
};

TEST_F(QueuePage, FailuresComeFirstThenWhatRunsThenWhatWaitsInItsOrder) {
    add(JobState::kDone);     // 2
    add(JobState::kWaiting);  // 3
    add(JobState::kFailed);   // 4
    add(JobState::kWaiting);  // 5
    show();
    EXPECT_LT(top_of(4), top_of(1));
    EXPECT_LT(top_of(1), top_of(3));
    EXPECT_LT(top_of(3), top_of(5));
    EXPECT_LT(top_of(5), top_of(2));
    clear();
    ASSERT_TRUE(robot->click("Job 5/Earlier"));
    ASSERT_THAT(emitted<CommandJob>(), SizeIs(1));
    EXPECT_EQ(emitted<CommandJob>()[0], (CommandJob{5, JobCommand::kEarlier}));
    EXPECT_EQ(robot->find("Job 1/Earlier"), nullptr) << "it is being rendered";
}

TEST_F(QueuePage, ARenderNamesItsReviewMovie) {
    view.jobs[0].output = "/shots/wall_render_v001/wall_v001.####.png";
    view.jobs[0].movie = "/shots/wall_render_v001.mp4";
    show();
    EXPECT_NE(robot->find("Job 1/Files: /shots/wall_render_v001/wall_v001.####.png  ·  "
                          "wall_render_v001.mp4"),
              nullptr);
}

// The estimate never promises less than the analysis beside it says.
TEST_F(QueuePage, TheEstimateGoesByTheAnalysisThatIsOnItsWay) {
    set_workspace(shell->state(), Workspace::kJobs);
    view.preview.analysing = true;
    view.preview.done = 10;
    view.preview.total = 100;
    view.preview.seconds_left = 900;
    shell->state().output.output = "/tmp/nowhere/a.####.png";
    robot->frames(3);
    clear();
    ASSERT_TRUE(robot->click("Export/Render frames"));
    ASSERT_THAT(emitted<SubmitJob>(), SizeIs(1));
    EXPECT_GT(emitted<SubmitJob>()[0].estimated_s, 900);
}

TEST_F(QueuePage, AnErrorOfAnOutputStaysOnThePage) {
    add(JobState::kFailed);
    view.jobs[1].problem.setting = "run.overwrite";
    show();
    ASSERT_TRUE(robot->click("Job 2/Show what it is about"));
    robot->frames(2);
    EXPECT_EQ(shell->state().workspace, Workspace::kJobs);
    EXPECT_TRUE(shell->state().pointed.found) << shell->state().pointed.name;
}

TEST_F(QueuePage, AReasonIsShownWholeOnASmallScreen) {
    ImGui::GetIO().DisplaySize = {1280, 720};
    add(JobState::kFailed);
    add(JobState::kFailed);
    show();
    const float one_line = top_of(2) - top_of(3);
    view.jobs[2].error =
        "The shape does not lie on the region on its reference frame, which is frame 1001 of "
        "/shots/reel_12/sequence_004/plates/interior_day_v003.####.exr. Draw it over the surface, "
        "or choose another reference frame under Motion, then render the shot again.";
    robot->frames(2);
    EXPECT_GT(top_of(2) - top_of(3), one_line + 10);
}

TEST(JobWords, SayWhatARenderDoesAndNoTimeThatIsNotKnown) {
    JobView job;
    job.id = 3;
    job.state = JobState::kRunning;
    EXPECT_EQ(ui::job_summary(job), "Job 3: starting");
    job.stage = WorkStage::kAnalyse;
    job.total = 104;
    job.done = 2;
    EXPECT_EQ(ui::job_summary(job), "Job 3: analysing 1%");
    job.left_s = 84;
    EXPECT_EQ(ui::job_summary(job), "Job 3: analysing 1%, 1:24 left");
    EXPECT_EQ(ui::job_line(job), "Analysing  2 of 104   1:24 left");
    job.state = JobState::kPaused;
    EXPECT_EQ(ui::job_summary(job), "Job 3: paused 1%");
    job.state = JobState::kFailed;
    job.error = "The disk is full.";
    EXPECT_EQ(ui::job_line(job), "Failed. The disk is full.");
}

class QueueAfterARestart : public SessionTest {};

TEST_F(QueueAfterARestart, OneClickShowsTheFrameAndTheSettingOfAFailure) {
    const std::string jobs = (folder / "state" / "jobs").string();
    std::filesystem::create_directories(jobs);
    JobRecord record;
    record.name = "job-1-1";
    record.state = JobState::kFailed;
    record.label = "shot, frames 1-4";
    record.plate = (folder / "frames" / "####.png").string();
    record.error = "The plate has no light on frame 3.";
    record.problem.frame = 3;
    record.problem.region = "Region 1";
    record.problem.setting = "light.strength";
    ASSERT_TRUE(write_job(jobs, record));
    record.name = "job-1-2";
    record.plate = "/another/shot.####.png";
    ASSERT_TRUE(write_job(jobs, record));
    session->act(OpenAny{(folder / "frames").string()});
    ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
    for (int k = 0; k < 2; ++k) {
        robot->key("Ctrl+Shift+N");
        robot->frames(3);
    }
    ASSERT_TRUE(wait([&] { return !session->view().jobs.empty(); }));
    EXPECT_THAT(session->view().jobs, SizeIs(1)) << "those of other shots are not this one's";
    for (const Notice& notice : session->view().notices)
        EXPECT_NE(notice.kind, NoticeKind::kError) << "it failed long ago: " << notice.text;
    const RegionId first = session->view().project.regions.front()->id;
    ASSERT_NE(session->view().selected, first);
    set_workspace(shell->state(), Workspace::kJobs);
    robot->frames(3);
    ASSERT_TRUE(robot->click("Show what it is about"));
    robot->frames(4);
    EXPECT_EQ(session->view().frame, 3);
    EXPECT_EQ(session->view().project.regions.front()->name, "Region 1");
    EXPECT_EQ(session->view().selected, first);
    EXPECT_EQ(shell->state().workspace, Workspace::kLight);
    EXPECT_TRUE(shell->state().pointed.found) << shell->state().pointed.name;
    robot->frames(360);
    EXPECT_TRUE(shell->state().pointed.name.empty()) << "the mark goes by itself";
}

}  // namespace
}  // namespace weft::test
