#include "app/render/render_estimate.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

EstimateInputs clip() {
    EstimateInputs in;
    in.size = {854, 480};
    in.frames = in.analysed = 50;
    in.regions = 1;
    in.extension = "png";
    return in;
}

TEST(RenderEstimate, MoreWorkTakesLongerAndMoreCoresLess) {
    const double seconds = estimate_render(clip()).seconds;
    EXPECT_GT(seconds, 0);
    const auto with = [](auto&& change) {
        EstimateInputs in = clip();
        change(in);
        return estimate_render(in).seconds;
    };
    EXPECT_GT(with([](EstimateInputs& in) { in.frames *= 2; }), seconds);
    EXPECT_GT(with([](EstimateInputs& in) { in.size = {1708, 960}; }), 3 * seconds);
    EXPECT_GT(with([](EstimateInputs& in) { in.regions = 3; }), seconds);
    EXPECT_LT(with([](EstimateInputs& in) { in.analysed = 0; }), seconds / 2);
    EXPECT_GT(with([](EstimateInputs& in) { in.mattes_painted = true; }), seconds);
    EXPECT_LT(with([](EstimateInputs& in) { in.motion_given = true; }), seconds);
    EXPECT_LT(with([](EstimateInputs& in) { in.quality = Quality::kDraft; }), seconds);
    EXPECT_LT(with([](EstimateInputs& in) { in.threads = 8; }), seconds / 2);
    EXPECT_NEAR(with([](EstimateInputs& in) { in.speed = 2; }), seconds / 2, 1e-9);
}

// A machine that has other things to do takes longer than ever before.
TEST(RenderEstimate, GoesByAnAnalysisThatIsOnItsWay) {
    EstimateInputs in = clip();
    const double seconds = estimate_render(in).seconds;
    in.analysis_s = 0.01;
    EXPECT_EQ(estimate_render(in).seconds, seconds) << "what it began with does not count";
    in.analysis_s = 400;
    EXPECT_GT(estimate_render(in).seconds, 400);
    EXPECT_LT(estimate_render(in).seconds, 400 + seconds);
    in.analysed = 0;
    EXPECT_LT(estimate_render(in).seconds, seconds) << "it is done";
}

TEST(RenderEstimate, MemoryDoesNotGrowWithTheShotAndDiskDoes) {
    EstimateInputs in = clip();
    const RenderEstimate once = estimate_render(in);
    in.frames *= 20;
    const RenderEstimate long_one = estimate_render(in);
    EXPECT_EQ(long_one.memory_bytes, once.memory_bytes);
    EXPECT_EQ(long_one.disk_bytes, 20 * once.disk_bytes);
    in.extension = "exr";
    EXPECT_GT(estimate_render(in).disk_bytes, long_one.disk_bytes);
}

// Both were measured on film (docs/BENCHMARKS.md): 32.5 s and 887 MB, 28.3 s as a draft.
TEST(RenderEstimate, IsRightOnAPaintedShot) {
    EstimateInputs in = clip();
    in.size = {960, 540};
    in.frames = 40;
    in.analysed = 49;  // with those that show light and form
    in.mattes_painted = true;
    const RenderEstimate final_one = estimate_render(in);
    EXPECT_NEAR(final_one.seconds, 32.5, 5);
    EXPECT_NEAR(static_cast<double>(final_one.memory_bytes), 887e6, 0.15 * 887e6);
    in.quality = Quality::kDraft;
    EXPECT_NEAR(estimate_render(in).seconds, 28.3, 5);
}

TEST(RenderEstimate, TheAnalysisReachesToReferencesAndPaintedMattes) {
    Project project;
    const FrameRange shot{1, 201};
    EXPECT_EQ(analysed_frames(project, 10, 12, shot), 3u);
    Region region;
    region.reference_frames = {40};
    region.corrections[8] = {};
    project.regions.emplace_back(region);
    EXPECT_EQ(analysed_frames(project, 10, 12, {8, 41}), 33u);
    EXPECT_EQ(analysed_frames(project, 10, 12, shot), 88u) << "light is measured 48 frames around";
    region.reference_frames.clear();
    region.matte = Leaf<MatteSource>(MatteSource{});
    project.regions[0] = Leaf<Region>(region);
    EXPECT_EQ(analysed_frames(project, 10, 12, shot), 58u) << "around the first one";
    region.enabled = false;
    project.regions[0] = Leaf<Region>(region);
    EXPECT_EQ(analysed_frames(project, 10, 12, shot), 3u);
}

}  // namespace
}  // namespace weft
