// The frame that a texture is placed on, the way around gaps, and frame numbers at their ends.
#include "app/shot/shot.h"
#include "engine/core/frame_range.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class ReferenceTest : public ShotTest {
  protected:
    void empty_matte(int frame) const {
        ASSERT_TRUE(write_matte(in("masks/000" + std::to_string(frame) + ".png"),
                                Matte(Card::kPlate), WriteRule::own()));
    }
    static void place_on(JobSpec& job, int frame) {
        Leaf<Region>& region = job.project.regions[0];
        region = region.with([&](Region& r) { r.reference_frames = {frame}; });
    }
    static std::string error_of(const JobSpec& job, ErrorCode code) {
        const auto shot = open_shot(job.project);
        EXPECT_FALSE(shot);
        if (shot) return {};
        EXPECT_EQ(shot.error().code, code);
        return shot.error().text();
    }
    // The header tells the two apart, since one has the setting.
    std::vector<float> pixels(const std::string& folder, int frame) const {
        const auto read = read_image(in(folder + "/000" + std::to_string(frame) + ".png"));
        EXPECT_TRUE(read);
        if (!read) return {};
        const ImageF3& rgb = read->rgb;
        return {rgb.data(), rgb.data() + rgb.size_bytes() / sizeof(float)};
    }
    // Moves frame 1 of the plate and its matte to another number.
    void renumber_first(int number) const {
        for (const char* folder : {"frames", "masks"}) {
            fs::rename(in(std::string(folder) + "/0001.png"),
                       in(std::string(folder) + "/" + std::to_string(number) + ".png"));
        }
    }
};

TEST_F(ReferenceTest, TheDefaultLeavesOutEmptyFramesAndIsTheSameForEveryPart) {
    empty_matte(1);
    empty_matte(2);
    const auto result = run_job(spec("out"), {}, {});
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_EQ(result->shot->references[0].frame, 3);
    EXPECT_TRUE(result->shot->references[0].by_default);
    EXPECT_THAT(result->shot->notes, ElementsAre(HasSubstr("the reference frame is 3")));
    EXPECT_THAT(result->warnings, Not(Contains(HasSubstr("reference frame"))));

    JobSpec given = spec("given");
    place_on(given, 3);
    ASSERT_TRUE(run_job(given, {}, {}));
    for (int frame = 1; frame <= kFrames; ++frame)
        EXPECT_EQ(pixels("given", frame), pixels("out", frame)) << frame;

    JobSpec part = spec("part");
    part.project.settings.frames = "5";
    ASSERT_TRUE(run_job(part, {}, {}));
    EXPECT_EQ(contents("part").at("0005.png"), contents("out").at("0005.png"));
}

TEST_F(ReferenceTest, AGoodFirstFrameIsKeptSilently) {
    const auto shot = open_shot(spec("out").project);
    ASSERT_TRUE(shot) << shot.error().text();
    EXPECT_EQ((*shot)->references[0].frame, 1);
    EXPECT_THAT((*shot)->notes, IsEmpty());
    EXPECT_THAT((*shot)->warnings, IsEmpty());
}

TEST_F(ReferenceTest, AGivenFrameWithAnEmptyMatteNamesABetterOne) {
    empty_matte(1);
    JobSpec job = spec("out");
    place_on(job, 1);
    const auto result = run_job(job, {}, {});
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_THAT(result->warnings,
                Contains(AllOf(HasSubstr("empty on the reference frame 1."),
                               HasSubstr("place the texture there (reference_frames 2)."))));
}

TEST_F(ReferenceTest, AMissingFrameIsNamedWithTheFramesOfThePlate) {
    JobSpec job = spec("out");
    place_on(job, 99);
    EXPECT_THAT(error_of(job, ErrorCode::kMissingFrames),
                HasSubstr("reference frame 99 is not in the plate (1-6)"));
}

TEST_F(ReferenceTest, AGapNamesTheSideThatCanBeRendered) {
    for (const char* folder : {"masks", "frames"}) {
        for (const char* file : {"/0003.png", "/0004.png"})
            fs::rename(in(std::string(folder) + file), in(std::string("tile") + file[4] + ".bak"));
        JobSpec job = spec("out");
        job.project.settings.frames = "1-2,5-6";
        EXPECT_THAT(error_of(job, ErrorCode::kMissingFrames),
                    AllOf(HasSubstr("frames 3-4"), HasSubstr("reference frame 1"),
                          HasSubstr("render only frames 1-2")))
            << folder;
        job.project.settings.frames = "5-6";
        EXPECT_THAT(error_of(job, ErrorCode::kMissingFrames),
                    AllOf(HasSubstr("frames 3-4"), HasSubstr("reference_frames 5")))
            << folder;
        place_on(job, 5);
        EXPECT_TRUE(open_shot(job.project)) << folder;
        for (const char* file : {"/0003.png", "/0004.png"})
            fs::rename(in(std::string("tile") + file[4] + ".bak"), in(std::string(folder) + file));
    }
}

// The plate has frames 2 to 6 and one more, a hundred million away.
TEST_F(ReferenceTest, NumbersFarApartCostNeitherTimeNorMemory) {
    for (const int far_away : {kMaxFrameNumber, -kMaxFrameNumber}) {
        renumber_first(far_away);
        for (const MissingFrames missing :
             {MissingFrames::kError, MissingFrames::kHold, MissingFrames::kSkip}) {
            JobSpec job = spec("out");
            job.project.plate.missing = missing;
            EXPECT_THAT(error_of(job, ErrorCode::kMissingFrames),
                        AllOf(HasSubstr("The plate has no frames "), HasSubstr("99999")));
            job.project.settings.frames = "2-6";
            place_on(job, 2);
            EXPECT_TRUE(open_shot(job.project));
        }
        for (const char* folder : {"frames", "masks"}) {
            fs::rename(in(std::string(folder) + "/" + std::to_string(far_away) + ".png"),
                       in(std::string(folder) + "/0001.png"));
        }
    }
}

TEST_F(ReferenceTest, TheLastNumberCanBeRendered) {
    for (const char* folder : {"frames", "masks"}) {
        for (int frame = 1; frame <= kFrames; ++frame) {
            fs::rename(in(std::string(folder) + "/000" + std::to_string(frame) + ".png"),
                       in(std::string(folder) + "/" +
                          std::to_string(kMaxFrameNumber - kFrames + frame) + ".png"));
        }
    }
    JobSpec job = spec("out");
    ASSERT_TRUE(run_job(job, {}, {}));
    EXPECT_EQ(contents("out").size(), static_cast<std::size_t>(kFrames));
}

TEST_F(ReferenceTest, AFileNumberedBeyondTheRangeIsNamed) {
    fs::copy_file(in("frames/0001.png"), in("frames/2147483647.png"));
    EXPECT_THAT(
        error_of(spec("out"), ErrorCode::kUnreadable),
        AllOf(HasSubstr("frames/2147483647.png"), HasSubstr("frame number beyond 100000000")));
}

}  // namespace
}  // namespace weft::test
