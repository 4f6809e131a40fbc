// A resumed run keeps the frames that were made from the inputs of now, and says which of them
// changed.
#include <chrono>
#include <functional>

#include "app/farm/farm.h"
#include "app/render/existing_frames.h"
#include "app/render/input_hashes.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/media/metadata.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ResumeInputs : public ShotTest {
  protected:
    void SetUp() override {
        ShotTest::SetUp();
        replacing_.rule = WriteRule::own();
        ASSERT_TRUE(write_matte(in("key.png"), card_matte(0)));
    }
    static JobSpec resumed(JobSpec job) {
        job.existing = ExistingFrames::kResume;
        return job;
    }
    // From files, or painted on the first frame.
    JobSpec job(bool painted, const std::string& out = "out") const {
        JobSpec made = spec(out);
        made.project.regions[0] = made.project.regions[0].with([&](Region& r) {
            if (painted) {
                MatteSource matte;
                matte.keyframes[1] = {in("key.png")};
                r.matte = matte;
            }
            r.reference_frames = {1};
        });
        return made;
    }
    // Without what is measured on frames near each frame and near the reference frame.
    JobSpec unmeasured() const {
        JobSpec made = job(false);
        made.project.regions[0] = made.project.regions[0].with([](Region& r) {
            r.finish.grain = r.finish.focus = 0;
            r.finish.shutter_deg = 0;
            r.form.source = FormSource::kFlat;
        });
        return made;
    }
    static std::vector<int> rendered(const JobResult& result) {
        std::vector<int> out;
        for (const FrameResult& frame : result.frames)
            if (!frame.skipped) out.push_back(frame.frame);
        return out;
    }
    // Renders, changes inputs, resumes, and compares with a render from nothing.
    JobResult resumed_after(const JobSpec& job, const std::function<void()>& change) {
        EXPECT_TRUE(run_job(job, {}, {}));
        change();
        const auto result = run_job(resumed(job), {}, {});
        EXPECT_TRUE(result) << (result ? "" : result.error().text());
        JobSpec fresh = job;
        fresh.project.output.path = in("fresh/####.png");
        fresh.cache.keep = false;
        EXPECT_TRUE(run_job(fresh, {}, {}));
        EXPECT_EQ(contents("out"), contents("fresh"))
            << "frames are those of a render from nothing";
        fs::remove_all(in("fresh"));
        return result ? *result : JobResult();
    }
    // A picture of the same size, written as a copy that keeps the time.
    void darken(const std::string& name) const {
        const auto time = fs::last_write_time(in(name));
        PlateFrame picture = *read_image(in(name));
        for (int y = 0; y < picture.rgb.height(); ++y)
            for (int x = 0; x < 3 * picture.rgb.width(); ++x)
                picture.rgb.row(y)[x] *= 0.95f;
        ASSERT_TRUE(write_image(in(name), picture.rgb, {}, replacing_));
        fs::last_write_time(in(name), time);
    }
    WriteOptions replacing_;
    std::vector<std::string> said_;  // of what was submitted last
};

TEST_F(ResumeInputs, UnchangedInputsKeepAllFrames) {
    const JobResult result = resumed_after(job(false), [&] {
        for (const char* name : {"frames/0002.png", "masks/0003.png", "tile.png"})
            fs::last_write_time(in(name), fs::file_time_type::clock::now());
    });
    EXPECT_THAT(rendered(result), IsEmpty());
    EXPECT_THAT(result.warnings, IsEmpty());
}

TEST_F(ResumeInputs, ACorrectedMatteIsRenderedAgainFromItsFrameOn) {
    const JobResult result = resumed_after(unmeasured(), [&] {
        ASSERT_TRUE(write_matte(in("masks/0004.png"), card_matte(1), replacing_.rule));
    });
    // The surface is followed from frame 1, so frames 1 to 3 know nothing of frame 4.
    EXPECT_THAT(rendered(result), ElementsAre(4, 5, 6));
    EXPECT_THAT(result.warnings,
                ElementsAre(AllOf(HasSubstr("The mattes changed since frames 4-6 were rendered"),
                                  HasSubstr("3 are rendered again"))));
}

TEST_F(ResumeInputs, ACorrectedPaintedMatteIsRenderedAgain) {
    const JobResult result = resumed_after(job(true), [&] {
        ASSERT_TRUE(write_matte(in("key.png"), card_matte(2), replacing_.rule));
    });
    EXPECT_THAT(rendered(result), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("The mattes changed")));
}

TEST_F(ResumeInputs, AReplacedPlateFrameOfTheSameSizeAndTimeIsRenderedAgain) {
    const JobResult result = resumed_after(unmeasured(), [&] { darken("frames/0006.png"); });
    EXPECT_THAT(rendered(result), ElementsAre(6));
    EXPECT_THAT(result.warnings,
                ElementsAre(HasSubstr("The plate changed since frame 6 was rendered")));
}

TEST_F(ResumeInputs, AReplacedTextureIsRenderedAgainAndNamed) {
    const JobResult result = resumed_after(job(false), [&] { darken("tile.png"); });
    EXPECT_THAT(rendered(result), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("The texture changed")));
}

TEST_F(ResumeInputs, OtherSettingsAreSaid) {
    ASSERT_TRUE(run_job(job(false), {}, {}));
    JobSpec other = resumed(job(false));
    other.project.regions[0] =
        other.project.regions[0].with([](Region& r) { r.placement.scale = 2; });
    const auto result = run_job(other, {}, {});
    ASSERT_TRUE(result);
    EXPECT_EQ(rendered(*result).size(), 6u);
    EXPECT_THAT(result->warnings, ElementsAre(HasSubstr("Frames 1-6 were rendered with other")));
}

// A delivery that arrives in parts.
TEST_F(ResumeInputs, FramesAddedToThePlateLeaveTheFirstOnes) {
    for (const char* folder : {"frames", "masks"})
        fs::rename(in(folder) + "/0006.png", in(folder) + ".6.png");
    // What is measured near the end of a plate depends on where it ends.
    const JobResult result = resumed_after(unmeasured(), [&] {
        for (const char* folder : {"frames", "masks"})
            fs::rename(in(folder) + ".6.png", in(folder) + "/0006.png");
    });
    EXPECT_THAT(rendered(result), ElementsAre(6));
    EXPECT_THAT(result.warnings, IsEmpty());
}

TEST_F(ResumeInputs, AShotCopiedElsewhereIsResumedThere) {
    ASSERT_TRUE(run_job(job(true), {}, {}));
    const auto before = contents("out");
    const fs::path first = folder_, moved = folder_.string() + "_moved";
    fs::copy(first, moved, fs::copy_options::recursive);
    folder_ = moved;
    fs::remove_all(in("cache"));
    fs::remove(in("out/0003.png"));
    const auto result = run_job(resumed(job(true)), {}, {});
    folder_ = first;
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_THAT(rendered(*result), ElementsAre(3));
    EXPECT_THAT(result->warnings, IsEmpty());
    folder_ = moved;
    EXPECT_EQ(contents("out"), before);
    fs::remove_all(moved);
    folder_ = first;
}

TEST_F(ResumeInputs, FramesOfAnEarlierWeftCannotBeCompared) {
    ASSERT_TRUE(run_job(job(false), {}, {}));
    for (const char* name : {"out/0002.png", "out/0003.png"}) {
        auto texts = read_recipe_metadata(in(name));
        ASSERT_EQ(texts.erase("weft:inputs"), 1u);
        WriteOptions options = replacing_;
        options.metadata.assign(texts.begin(), texts.end());
        ASSERT_TRUE(write_image(in(name), read_image(in(name))->rgb, {}, options));
    }
    const auto result = run_job(resumed(job(false)), {}, {});
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_THAT(rendered(*result), ElementsAre(2, 3));
    EXPECT_THAT(result->warnings,
                ElementsAre(AllOf(HasSubstr("An earlier Weft rendered frames 2-3"),
                                  HasSubstr("these 2 are rendered again"))));
}

// Corrected inputs would give frames of two kinds: in one job, and in one that is submitted again.
TEST_F(ResumeInputs, TasksOfAFarmRenderWhatWasSubmittedAndKeepWhatHoldsStill) {
    FarmOptions farm;
    farm.project = unmeasured().project;
    farm.project_file = in("shot.weft");
    farm.folder = in("farm");
    farm.chunk = 3;
    farm.rule = replacing_.rule;
    const auto submit = [&] {
        JobSpec spec = resumed(unmeasured());
        const auto checked = check_job(spec);
        ASSERT_TRUE(checked) << checked.error().text();
        said_ = checked->warnings;
        const auto written = write_farm_job(farm, checked->shot);
        ASSERT_TRUE(written) << written.error().text();
    };
    const auto run = [&](const std::string& stage, int index) -> Expected<JobResult> {
        WEFT_TRY(task, read_farm_task(in("farm/job.json"), stage, index));
        JobSpec spec = unmeasured();
        spec.project = task.project;
        spec.settings = task.settings;
        spec.inputs = task.inputs;
        spec.inputs_of = task.inputs_of;
        spec.stage = task.stage;
        spec.existing = task.existing;
        spec.cache.folder = task.cache;
        return run_job(spec, {}, {});
    };
    submit();
    EXPECT_THAT(said_, IsEmpty());
    ASSERT_TRUE(run("analyse", 0));
    ASSERT_TRUE(run("frames", 0));
    // Of a frame that another task renders.
    ASSERT_TRUE(write_matte(in("masks/0006.png"), card_matte(1), replacing_.rule));
    const auto refused = run("frames", 0);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(refused.error().text(), AllOf(HasSubstr("the mattes"), HasSubstr("Submit again")));
    submit();
    EXPECT_THAT(said_, IsEmpty()) << "frames 1 to 3 do not depend on it";
    ASSERT_TRUE(run("analyse", 0));
    const auto first = run("frames", 0), second = run("frames", 1);
    ASSERT_TRUE(first && second);
    EXPECT_THAT(rendered(*first), IsEmpty());
    EXPECT_THAT(rendered(*second), ElementsAre(4, 5, 6));
    ASSERT_TRUE(write_matte(in("masks/0002.png"), card_matte(4), replacing_.rule));
    submit();
    EXPECT_THAT(said_, ElementsAre(HasSubstr("The mattes changed since frames 2-6 were rendered")));
    const auto third = run("frames", 0);
    ASSERT_TRUE(third);
    EXPECT_THAT(rendered(*third), ElementsAre(2, 3));
}

// The text in a frame's header depends on neither the rendered part nor the place.
TEST_F(ResumeInputs, TheInputsOfAFrameAreTheSameForEveryPartOfTheShot) {
    const auto hashes = [&](const std::string& frames, const std::vector<int>& of) {
        Project project = unmeasured().project;
        project.settings.frames = frames;
        const auto shot = open_shot(project);
        EXPECT_TRUE(shot);
        return InputHashes(*shot, of);
    };
    const InputHashes whole = hashes("", {1, 2, 3, 4, 5, 6}), part = hashes("4-5", {1, 2, 3, 4, 5});
    EXPECT_EQ(whole.text(4), part.text(4));
    EXPECT_EQ(whole.text({1, 2, 3}), part.text({1, 2, 3}));
    EXPECT_NE(whole.text(4), whole.text(5));
    EXPECT_THAT(whole.text(4),
                ::testing::MatchesRegex("plate:[0-9a-f]+,mattes:[0-9a-f]+,texture:[0-9a-f]+"));
    EXPECT_THAT(changed_inputs("plate:1,mattes:2", "plate:1,mattes:2"), IsEmpty());
    EXPECT_THAT(changed_inputs("plate:1,mattes:2", "plate:3,mattes:2,passes:4"),
                ElementsAre("the plate", "the passes"));
}

}  // namespace
}  // namespace weft::test
