// What a surface is, and how it moves, must not depend on the size in which its plate is delivered.
#include "tests/pipeline/plate_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/motion/follow_size.h"
#include "tests/mask/moving_disc.h"

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

// Of frame 1, with the matte painted on frame 0 and, if `both`, on the last one.
Matte carried(Size size, FlowQuality quality, bool both) {
    MemoryShot shot = scene::shot_of(size, 0.8f, 1);
    shot.keys[{0, 0}] = shot.mattes[{0, 0}];
    ShotPlan plan = scene::plan_of(quality);
    plan.regions[0].matte_keys = {0};
    if (both) {
        // What was painted first, moved by whole pixels of the smallest plate.
        const int gain = size.width / scene::kSmallest.width;
        Matte& moved = shot.keys[{0, 2}] = Matte(size);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const int u = std::min(x + 5 * gain, size.width - 1), v = std::max(y - 2 * gain, 0);
                moved.at(x, y) = shot.keys[{0, 0}].at(u, v);
            }
        }
        plan.regions[0].matte_keys = {0, 2};
    }
    shot.mattes.clear();
    MemoryAnalysisStore store;
    const Status done = analyse_shot(shot, plan, store, {}, {});
    EXPECT_TRUE(done) << (done ? "" : done.error().text());
    const auto bytes = store.get({0, 1, AnalysisKind::kMatte});
    return bytes ? decode_matte(*bytes)->matte : Matte();
}

TEST_P(PlateSizes, CarryTheSameMatte) {
    for (const bool both : {false, true}) {
        const Matte smallest = carried(scene::kSmallest, GetParam(), both);
        const Size size = both ? Size{2560, 1440} : Size{1280, 720};
        const Matte found = carried(size, GetParam(), both);
        ASSERT_EQ(found.size(), size);
        EXPECT_GT(test::overlap(reduced(found, scene::kSmallest), smallest), 0.985) << both;
    }
}

INSTANTIATE_TEST_SUITE_P(Qualities, PlateSizes,
                         testing::Values(FlowQuality::kDraft, FlowQuality::kFinal),
                         [](const auto& of) {
                             return of.param == FlowQuality::kDraft ? "Draft" : "Final";
                         });

}  // namespace
}  // namespace weft
