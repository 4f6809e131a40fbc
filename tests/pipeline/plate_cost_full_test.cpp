// What following costs for each pixel must not rise with the plate's size.
#include <gtest/gtest.h>

#include <ctime>

#include "engine/core/parallel.h"
#include "tests/pipeline/plate_sizes.h"

namespace weft {
namespace {

constexpr double kChance = 1.25;  // times: clocks and caches

double cpu_s_per_pixel(Size size, FlowQuality quality, float contrast) {
    const MemoryShot shot = scene::shot_of(size, contrast, 0.8f);
    MemoryAnalysisStore store;
    const std::clock_t start = std::clock();
    EXPECT_TRUE(analyse_shot(shot, scene::plan_of(quality), store, {}, {}));
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC /
           (static_cast<double>(size.width) * size.height);
}

class PlateCost : public testing::TestWithParam<FlowQuality> {
  protected:
    void SetUp() override { set_thread_count(1); }
    void TearDown() override { set_thread_count(0); }
};

TEST_P(PlateCost, OfATexturedSurfaceDoesNotRise) {
    (void)cpu_s_per_pixel(scene::kSmallest, GetParam(), 0.8f);  // the program's first touches
    const double smallest = cpu_s_per_pixel(scene::kSmallest, GetParam(), 0.8f);
    for (const Size size : scene::kSizes)
        EXPECT_LT(cpu_s_per_pixel(size, GetParam(), 0.8f), kChance * smallest) << size.width;
}

// From the size on at which this wall's structure no longer stands out of its grain, so that both
// its own motion and its outline's are measured: 854 pixels wide in draft, 960 in final.
TEST_P(PlateCost, OfAFaintSurfaceDoesNotRise) {
    const double first = cpu_s_per_pixel(scene::kSizes[0], GetParam(), 0.06f);
    for (const Size size : scene::kSizes)
        EXPECT_LT(cpu_s_per_pixel(size, GetParam(), 0.06f), kChance * first) << size.width;
}

INSTANTIATE_TEST_SUITE_P(Qualities, PlateCost,
                         testing::Values(FlowQuality::kDraft, FlowQuality::kFinal),
                         [](const auto& of) {
                             return of.param == FlowQuality::kDraft ? "Draft" : "Final";
                         });

}  // namespace
}  // namespace weft
