// What is known of a render before any work.
#include "app/render/job_setup.h"

#include "app/render/job_frames.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class JobSetupTest : public ShotTest {
  protected:
    Expected<JobSetup> set_up(const JobSpec& spec) { return set_up_job(spec, {}, shot_); }
    std::shared_ptr<const Shot> shot_;
};

TEST_F(JobSetupTest, ListsAllFramesAndPlansThoseThatAreStillToBeRendered) {
    JobSpec job = spec("out");
    const auto fresh = set_up(job);
    ASSERT_TRUE(fresh) << fresh.error().text();
    ASSERT_EQ(fresh->result.frames.size(), static_cast<std::size_t>(kFrames));
    EXPECT_EQ(fresh->plan.frames.size(), static_cast<std::size_t>(kFrames));
    EXPECT_EQ(shot_, fresh->shot);

    const std::vector<int> all = fresh->plan.frames;
    job.project.settings.frames = std::to_string(all[1]) + "," + std::to_string(all[4]);
    ASSERT_TRUE(run_job(job, {}, {}));
    job.project.settings.frames.clear();
    job.existing = ExistingFrames::kSkip;
    const auto rest = set_up(job);
    ASSERT_TRUE(rest) << rest.error().text();
    EXPECT_THAT(rest->plan.frames, ElementsAre(all[0], all[2], all[3], all[5]));
    EXPECT_EQ(rest->result.frames.size(), all.size());
    EXPECT_TRUE(rest->result.frames[1].skipped);
    EXPECT_FALSE(rest->result.frames[2].skipped);
}

TEST_F(JobSetupTest, RefusesBeforeItOpensTheShot) {
    JobSpec job = spec("out");
    job.project.output.path.clear();
    const auto none = set_up(job);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::kUsage);
    EXPECT_EQ(shot_, nullptr);
}

TEST_F(JobSetupTest, LeavesTheOpenShotWhenTheOutputIsWrong) {
    JobSpec job = spec("out");
    job.project.output.layers = {LayerKind::kPatch};
    const auto png = set_up(job);
    ASSERT_FALSE(png) << "layers need an EXR";
    EXPECT_THAT(png.error().text(), HasSubstr("EXR"));
    EXPECT_NE(shot_, nullptr);
    job.project.output.layers_path = in("layers/####.exr");
    const auto apart = set_up(job);
    ASSERT_TRUE(apart) << apart.error().text();
    ASSERT_TRUE(apart->layer_pattern);
    EXPECT_THAT(apart->layer_pattern->text(), HasSubstr("layers"));
}

TEST(JobFrames, AnExrIsKnownByItsName) {
    EXPECT_TRUE(is_exr("out/####.exr"));
    EXPECT_TRUE(is_exr("OUT.EXR"));
    EXPECT_FALSE(is_exr("exr/0001.png"));
}

TEST_F(JobSetupTest, NamesTheFramesThatAreLeftOut) {
    const auto made = set_up_job(spec("out"), {2}, shot_);
    ASSERT_TRUE(made) << made.error().text();
    EXPECT_THAT(made->result.warnings, testing::Contains(HasSubstr("Frame 2 cannot be read")));
}

}  // namespace
}  // namespace weft::test
