// A frame that cannot be written ends the job, and for any number of threads it is the same frame.

#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using ::testing::HasSubstr;

using FrameFailure = ShotTest;

TEST_F(FrameFailure, TheFirstIsReportedAndThoseBeforeItAreThere) {
    for (const int threads : {1, 2, 4}) {
        const std::string out = "out" + std::to_string(threads);
        JobSpec job = spec(out);
        job.threads = threads;
        job.cache.folder = in("cache." + out);  // it is analysed each time
        const auto name_of = [&](int frame) {
            return std::filesystem::path(job.project.output.path).parent_path() /
                   ("000" + std::to_string(frame) + ".png");
        };
        // Folders where frames are to be, once the outputs have been checked.
        const auto result = run_job(job, {}, [&](const ProgressEvent& event) {
            if (event.stage != WorkStage::kAnalyse) return;
            for (const int frame : {3, 5})
                std::filesystem::create_directories(name_of(frame) / "x");
        });
        ASSERT_FALSE(result) << threads;
        EXPECT_THAT(result.error().text(), HasSubstr("0003.png")) << threads;
        for (const int frame : {1, 2})
            EXPECT_TRUE(std::filesystem::is_regular_file(name_of(frame))) << threads << frame;
        if (threads == 1) {
            EXPECT_FALSE(std::filesystem::exists(name_of(4)));
        }
    }
}

}  // namespace
}  // namespace weft::test
