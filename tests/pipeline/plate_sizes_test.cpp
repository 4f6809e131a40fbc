// What a surface is, and how it moves, must not depend on the size in which its plate is delivered.
#include "tests/pipeline/plate_sizes.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace weft {
namespace {

// Where places of the surface lay on the first frame, in pixels of the smallest plate.
std::vector<Vec2> followed(Size size, FlowQuality quality, float contrast, float grain_levels) {
    MemoryAnalysisStore store;
    const Status done = analyse_shot(scene::shot_of(size, contrast, grain_levels),
                                     scene::plan_of(quality), store, {}, {});
    EXPECT_TRUE(done) << (done ? "" : done.error().text());
    const LatticeField field = stored_coords(store, scene::kFrames - 1);
    EXPECT_EQ(field.full_size(), size);
    const float scale = static_cast<float>(size.width) / static_cast<float>(scene::kSmallest.width);
    std::vector<Vec2> places;
    for (const Vec2 p : {Vec2(160, 110), Vec2(320, 180), Vec2(480, 260), Vec2(200, 250)})
        places.push_back(p + field.at(scale * p) / scale);
    return places;
}

class PlateSizes : public testing::TestWithParam<FlowQuality> {};

TEST_P(PlateSizes, FollowTheSameMotion) {
    for (const auto& [contrast, grain_levels] : {std::pair(0.8f, 1.0f), std::pair(0.06f, 0.8f)}) {
        const auto smallest = followed(scene::kSmallest, GetParam(), contrast, grain_levels);
        const float gone = scene::kFrames - 1;
        EXPECT_LT(distance(smallest[1], Vec2(320, 180) - gone * scene::kStep_px), 0.3f) << contrast;
        for (const Size size : scene::kSizes) {
            const auto places = followed(size, GetParam(), contrast, grain_levels);
            for (std::size_t k = 0; k < places.size(); ++k)
                EXPECT_LT(distance(places[k], smallest[k]), 0.1f) << size.width << " " << contrast;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Qualities, PlateSizes,
                         testing::Values(FlowQuality::kDraft, FlowQuality::kFinal),
                         [](const auto& of) {
                             return of.param == FlowQuality::kDraft ? "Draft" : "Final";
                         });

}  // namespace
}  // namespace weft
