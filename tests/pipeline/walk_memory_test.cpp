// Walks that are kept: a walk over the same frames again gives the bytes of one that knows nothing.
#include "engine/pipeline/walk_memory.h"

#include <gtest/gtest.h>

#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

constexpr int kPinned = 6;

std::map<int, Bytes> analysed(const MemoryShot& shot, const RegionPlan& region,
                              std::shared_ptr<WalkMemory> walks, bool keep = true) {
    ShotPlan plan = make_plan(region);
    plan.walks = std::move(walks);
    plan.keep_walks = keep;
    MemoryAnalysisStore store;
    const Status done = analyse_shot(shot, plan, store, {}, {});
    EXPECT_TRUE(done) << done.error().text();
    std::map<int, Bytes> coords;
    for (int frame = kFirst; frame <= kLast; ++frame) {
        auto bytes = store.get({0, frame, AnalysisKind::kCoords});
        EXPECT_TRUE(bytes) << frame;
        if (bytes) coords[frame] = std::move(*bytes);
    }
    return coords;
}

RegionPlan pinned(float dx) {
    RegionPlan region = make_region(sample_texture());
    region.reference_frames = {kFirst, kPinned};
    region.corrections[kPinned] = {{{80, 56}, {80 + dx, 56}}};
    return region;
}

std::shared_ptr<WalkMemory> memory(std::size_t bytes = 256 << 20) {
    return std::make_shared<WalkMemory>(bytes);
}

TEST(WalkMemory, GivesTheSameBytesWhenPinsMove) {
    const MemoryShot shot = make_wall(true);
    const auto walks = memory();
    const RegionPlan plain = make_region(sample_texture());
    EXPECT_EQ(analysed(shot, plain, walks), analysed(shot, plain, nullptr));
    EXPECT_EQ(walks->times_found(), 0);
    int found = 0;
    for (const float dx : {3.0f, 5.0f}) {
        EXPECT_EQ(analysed(shot, pinned(dx), walks), analysed(shot, pinned(dx), nullptr)) << dx;
        // Steps on all frames, and the track up to the pin.
        EXPECT_GE(walks->times_found(), found + kLast + kPinned - kFirst);
        found = walks->times_found();
    }
    EXPECT_NE(analysed(shot, pinned(3), walks), analysed(shot, pinned(5), walks));
}

TEST(WalkMemory, NeverTakesAnotherShotsWalks) {
    MemoryShot shot = make_wall();
    const auto walks = memory();
    const RegionPlan region = make_region(sample_texture());
    (void)analysed(shot, region, walks);
    // Another matte on one frame, another picture on the next.
    shot.mattes[{0, 4}] = box_matte({24, 16, 136, 90});
    shot.plates[5] = make_wall(true).plates[5];
    EXPECT_EQ(analysed(shot, region, walks), analysed(shot, region, nullptr));
}

TEST(WalkMemory, IsReadWithoutBeingAddedTo) {
    const MemoryShot shot = make_wall();
    const auto walks = memory();
    (void)analysed(shot, make_region(sample_texture()), walks, false);
    EXPECT_FALSE(walks->expects(kFirst + 1, kFirst));
    (void)analysed(shot, make_region(sample_texture()), walks, true);
    EXPECT_TRUE(walks->expects(kFirst + 1, kFirst));
    EXPECT_FALSE(walks->expects(kFirst, kFirst + 1));
    EXPECT_EQ(walks->times_found(), 0);
}

TEST(WalkMemory, DropsWhatWasNotUsedForLongest) {
    const MemoryShot shot = make_wall();
    const auto views = make_views(*shot.plates.at(kFirst), *color("srgb", "srgb"));
    const Matte inside = box_matte(kRegionBox);
    const WalkStep step{step_frame(views, inside, inside, nullptr), {}};
    const auto key = [](std::uint64_t k) { return Hash128{0, k}; };
    const std::size_t each = 24 * kShotSize.width * kShotSize.height;
    WalkMemory walks(3 * each);
    for (int k = 0; k < 3; ++k)
        walks.keep_step(key(static_cast<std::uint64_t>(k)), k + 1, k, step);
    EXPECT_TRUE(walks.find_step(key(0)));
    walks.keep_step(key(3), 4, 3, step);
    EXPECT_TRUE(walks.find_step(key(0)));
    EXPECT_FALSE(walks.find_step(key(1)));
    EXPECT_FALSE(walks.expects(2, 1));
    EXPECT_TRUE(walks.expects(3, 2));
    // Nothing is kept that is larger than all of it.
    WalkMemory small(each - 1);
    small.keep_step(key(0), 1, 0, step);
    EXPECT_FALSE(small.find_step(key(0)));
}

}  // namespace
}  // namespace weft
