#include "app/render/job_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/media/frame_writer.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

FrameResult frame(int number) {
    FrameResult result;
    result.frame = number;
    return result;
}

TEST(JobWarnings, NoneForAPlainJob) {
    EXPECT_THAT(warnings_of({frame(1), frame(2)}, {}), IsEmpty());
    EXPECT_THAT(warnings_of({}, {}), IsEmpty());
}

TEST(JobWarnings, NaNIsReportedByFrameAndCount) {
    std::vector<FrameResult> frames{frame(7), frame(8), frame(9)};
    frames[0].nonfinite = 1;
    frames[2].nonfinite = 12;
    frames[2].filled = 10;
    EXPECT_THAT(warnings_of(frames, {}),
                ElementsAre(AllOf(HasSubstr("frame 7 (1 pixel), frame 9 (12 pixels)"),
                                  HasSubstr("10 in a matte"), HasSubstr("3 outside"),
                                  Not(HasSubstr("frame 8")))));
}

TEST(JobWarnings, ALongListIsShortened) {
    std::vector<FrameResult> frames;
    for (int k = 0; k < 1000; ++k) {
        frames.push_back(frame(k));
        frames.back().nonfinite = 1;
    }
    const auto warnings = warnings_of(frames, {});
    EXPECT_THAT(warnings,
                ElementsAre(AllOf(HasSubstr("and 992 more frames"), HasSubstr("1000 outside"))));
    EXPECT_LT(warnings[0].size(), 400u);
}

TEST(JobWarnings, BrighterThanTheOutputOnlyByTheArtistsOwnSettings) {
    std::vector<FrameResult> frames{frame(1), frame(2)};
    frames[1].above_one = 12;
    Project project;
    project.regions.emplace_back(Region{});
    EXPECT_THAT(warnings_of(frames, project), IsEmpty());
    const auto with = [&](auto&& set) {
        Project changed = project;
        changed.regions[0] = changed.regions[0].with(set);
        return warnings_of(frames, changed);
    };
    EXPECT_THAT(with([](Region& r) { r.grade.exposure = 1; }),
                ElementsAre(AllOf(HasSubstr("12 pixels on frame 2"), HasSubstr("grade.exposure"))));
    EXPECT_THAT(with([](Region& r) { r.light.highlights = 1; }),
                ElementsAre(HasSubstr("light.highlights")));
    EXPECT_THAT(with([](Region& r) { r.grade.exposure = -1; }), IsEmpty());
    EXPECT_THAT(with([](Region& r) { r.enabled = false, r.grade.exposure = 1; }), IsEmpty());
    frames[1].above_one = 0;
    EXPECT_THAT(with([](Region& r) { r.grade.exposure = 1; }), IsEmpty());
}

class HighlightsTest : public ShotTest {};

TEST_F(HighlightsTest, AreUnsureOnAGreySurfaceAndTheJobSaysSo) {
    WriteOptions options;
    options.rule = WriteRule::own();
    for (int step = 0; step < kFrames; ++step) {
        ImageF3 grey = card_plate(step);
        for (int y = 0; y < grey.height(); ++y)
            for (int x = 0; x < grey.width(); ++x)
                std::fill_n(grey.pixel(x, y), 3, grey.pixel(x, y)[1]);
        const std::string file = "frames/000" + std::to_string(step + 1) + ".png";
        ASSERT_TRUE(write_image(in(file), grey, {}, options));
    }
    JobSpec job = spec("out");
    const auto warned = [&] {
        const auto result = run_job(job, {}, {});
        EXPECT_TRUE(result) << result.error().text();
        return result->warnings;
    };
    const std::string text = unsure_highlights_text(job.project.regions[0]->name);
    EXPECT_THAT(warned(), Not(Contains(text)));
    job.project.regions[0] = job.project.regions[0].with([](Region& r) { r.light.highlights = 1; });
    job.existing = ExistingFrames::kOverwrite;
    EXPECT_THAT(warned(), Contains(text));
}

TEST(JobWarnings, FramesWithAnEmptyMatte) {
    std::vector<FrameResult> frames{frame(1), frame(2), frame(3), frame(5)};
    for (const std::size_t k : {0, 1, 3})
        frames[k].untouched = true;
    EXPECT_THAT(warnings_of(frames, {}), ElementsAre(HasSubstr("empty on frames 1-2,5:")));
}

}  // namespace
}  // namespace weft::test
