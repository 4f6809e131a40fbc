// The analysis is made once, found again by content, and made anew when anything it depends on
// changes.
#include <fstream>

#include "engine/media/frame_writer.h"
#include "tests/session/shot_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;

class AnalysisCache : public ShotTest {
  protected:
    JobSpec scaled(const std::string& out, double scale) const {
        JobSpec job = spec(out);
        Region region = *job.project.regions[0];
        region.placement.scale = scale;
        job.project.regions[0] = region;
        return job;
    }
    fs::path any_blob() const {
        for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache"))
            if (entry.is_regular_file() && entry.path().filename() == "coords.3") return entry;
        return {};
    }
};

TEST_F(AnalysisCache, FindsTheAnalysisAgainForOtherPlacementsAndLights) {
    EXPECT_GE(analysed_steps(spec("first")), kFrames);
    EXPECT_EQ(analysed_steps(spec("second")), 0);
    EXPECT_EQ(contents("first"), contents("second"));
    EXPECT_EQ(analysed_steps(scaled("scaled", 2)), 0);
    EXPECT_NE(contents("first"), contents("scaled"));
}

TEST_F(AnalysisCache, ATouchedFrameOrMatteIsAnalysedAgain) {
    analysed_steps(spec("first"));
    ASSERT_TRUE(write_image(in("frames/0003.png"), card_plate(3), {}, {}));
    EXPECT_GE(analysed_steps(spec("second")), kFrames);
    ASSERT_TRUE(write_matte(in("masks/0005.png"), card_matte(3)));
    EXPECT_GE(analysed_steps(spec("third")), kFrames);
    JobSpec final = spec("final");
    final.project.settings.quality = Quality::kFinal;
    EXPECT_GE(analysed_steps(final), kFrames);
}

TEST_F(AnalysisCache, ADamagedBlobIsMadeAgain) {
    analysed_steps(spec("first"));
    const fs::path blob = any_blob();
    ASSERT_FALSE(blob.empty());
    for (const bool cut : {true, false}) {
        if (cut) {
            fs::resize_file(blob, fs::file_size(blob) / 2);
        } else {
            std::fstream file(blob, std::ios::in | std::ios::out | std::ios::binary);
            file.seekp(-3, std::ios::end);
            file.put('\x55');
        }
        const std::string out = cut ? "cut" : "flipped";
        EXPECT_GE(analysed_steps(spec(out)), 1) << out;
        EXPECT_EQ(contents(out), contents("first")) << out;
    }
}

TEST_F(AnalysisCache, ThePartsOfAShotAreTheWhole) {
    analysed_steps(spec("whole"));
    for (const char* part : {"5-6", "1,3", "2,4"}) {
        JobSpec job = spec("parts");
        job.project.settings.frames = part;
        job.cache.keep = false;
        job.cache.folder.clear();
        analysed_steps(job);
    }
    EXPECT_EQ(contents("parts"), contents("whole"));
}

TEST_F(AnalysisCache, TheLongestUnusedGoesFirst) {
    analysed_steps(spec("first"));
    JobSpec final = spec("final");
    final.project.settings.quality = Quality::kFinal;
    final.cache.limit_bytes = 1;
    analysed_steps(final);
    int analyses = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_ / "cache/analysis"))
        ++analyses;
    EXPECT_EQ(analyses, 1);  // the one in use stays
    EXPECT_EQ(analysed_steps(spec("again")) > 0, true);
}

}  // namespace
}  // namespace weft::test
