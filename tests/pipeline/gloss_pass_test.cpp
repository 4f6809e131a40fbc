// What highlights move over, found along the surface's motion and kept in the analysis.
#include "engine/pipeline/gloss_pass.h"

#include <gtest/gtest.h>

#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

ShotPlan glossy_plan() {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    region.light_source = LightSource::kPlate;
    region.highlights = 1;
    for (int frame = kFirst; frame <= kLast; ++frame)
        region.gloss_evidence.push_back(frame);
    return make_plan(std::move(region));
}

TEST(GlossPass, FindsTheStillSurfaceOnce) {
    const MemoryShot shot = make_wall();
    const ShotPlan plan = glossy_plan();
    MemoryAnalysisStore store;
    EXPECT_EQ(count_gloss_steps(plan, store), 1);
    ASSERT_TRUE(analyse_shot(shot, plan, store, {}, {}));
    EXPECT_FALSE(lacks_still_surface(plan, store, 0));
    const auto still = still_surface(plan, store, 0);
    ASSERT_TRUE(still);
    EXPECT_FALSE(still->box.empty());
    // Nothing moves over the wall but itself.
    EXPECT_LT(still->confidence, 0.2f);
}

TEST(GlossPass, LooksForNothingWithoutEvidence) {
    ShotPlan plan = glossy_plan();
    plan.regions[0].gloss_evidence.clear();
    const MemoryAnalysisStore store;
    EXPECT_FALSE(lacks_still_surface(plan, store, 0));
    const auto still = still_surface(plan, store, 0);
    ASSERT_TRUE(still);
    EXPECT_TRUE(still->box.empty());
}

TEST(GlossPass, TheStillSurfaceComesBackFromItsBytes) {
    StillSurface still;
    still.box = {-3, 2, 5, 8};
    still.pixel_px = 2;
    still.colour = ImageF3(still.box.size(), 0.25f);
    still.known = ImageF1(still.box.size(), 1.0f);
    still.known.at(1, 1) = 0;
    still.usual = 0.03f;
    still.confidence = 0.7f;
    const Bytes bytes = encode(still);
    const auto back = decode_still_surface(bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->box, still.box);
    EXPECT_EQ(back->usual, still.usual);
    EXPECT_EQ(back->confidence, still.confidence);
    EXPECT_EQ(back->known.at(1, 1), 0);
    EXPECT_NEAR(back->colour.at(0, 0, 1), 0.25f, 1e-3f);
    for (const std::size_t size : {std::size_t{0}, std::size_t{10}, bytes.size() - 1})
        EXPECT_FALSE(decode_still_surface(
            Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))));
    EXPECT_TRUE(decode_still_surface(encode(StillSurface())));
}

}  // namespace
}  // namespace weft
