#include "engine/pipeline/track_seams.h"

#include <gtest/gtest.h>

#include "engine/temporal/stretch_limit.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

LatticeField slid(float by) {
    LatticeField field(kShotSize, 8);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i)
            field.set_node(i, j, {by, 0});
    }
    return field;
}

// A shot whose texture was let go on a frame and is shown hidden from `first` to `last`; all of it
// would take `frames`.
struct Release {
    MemoryShot shot = make_wall();
    MemoryAnalysisStore store;
    PlanePyramid plane;

    Release(int first, int last, bool backwards, int frames = kReanchorFrames) {
        const std::shared_ptr<const TexturePicture> texture = sample_texture();
        ImageF3 picture = texture->pixels;
        color("srgb", "linear")->apply(picture);
        plane = PlanePyramid(picture, WrapMode::kMirror);
        const Bytes stretched = encode(slid(9)), relaxed = encode(slid(0));
        for (int f = first; f <= last; ++f) {
            EXPECT_TRUE(
                store.put({0, f, AnalysisKind::kHidingFrames}, encode(static_cast<float>(frames))));
            EXPECT_TRUE(store.put({0, f, AnalysisKind::kCoords}, relaxed));
            EXPECT_TRUE(
                store.put({0, f, AnalysisKind::kTrackBefore}, backwards ? relaxed : stretched));
            EXPECT_TRUE(
                store.put({0, f, AnalysisKind::kTrackAfter}, backwards ? stretched : relaxed));
        }
    }
    [[nodiscard]] std::vector<TrackSeam> seams(int reference, int first, int last) const {
        RegionPlan region = make_region(sample_texture());
        region.reference_frames = {reference};
        ShotPlan plan = make_plan(region, first, last);
        plan.display_from_working = color("linear", "srgb");
        auto made = make_track_seams(shot, plan, store, 0, plane);
        EXPECT_TRUE(made);
        return made ? *made : std::vector<TrackSeam>();
    }
};

// Of the region's middle, how much shows the track after on a frame.
float shown_after(const TrackSeam& seam, int frame) {
    float sum = 0;
    for (int y = 24; y < 88; y += 2) {
        for (int x = 28; x < 132; x += 2)
            sum += seam.share_after(frame, {static_cast<float>(x), static_cast<float>(y)});
    }
    return sum / (32 * 52);
}

TEST(ReleaseSeam, ChangesFromTheStretchedTextureToTheRelaxedOneBitByBit) {
    const Release release(3, 10, false);
    const auto seams = release.seams(1, 1, 10);
    ASSERT_EQ(seams.size(), 1u);
    EXPECT_TRUE(seams[0].covers(3) && seams[0].covers(10) && !seams[0].covers(2));
    EXPECT_LT(shown_after(seams[0], 3), 0.2f) << "on the frame itself nothing jumps";
    for (int f = 4; f <= 10; ++f) {
        EXPECT_GE(shown_after(seams[0], f), shown_after(seams[0], f - 1)) << f;
        EXPECT_LT(shown_after(seams[0], f) - shown_after(seams[0], f - 1), 0.4f) << f;
    }
    EXPECT_GT(shown_after(seams[0], 10), 0.1f);
}

// What is not followed well is stretched further on every frame: it is not shown for long.
TEST(ReleaseSeam, IsAsShortAsTheTrackSays) {
    const auto seams = Release(3, 6, false, 4).seams(1, 1, 10);
    ASSERT_EQ(seams.size(), 1u);
    EXPECT_LT(shown_after(seams[0], 3), 0.4f);
    EXPECT_GT(shown_after(seams[0], 6), 0.9f);
}

TEST(ReleaseSeam, IsTheSameForAPartOfTheShot) {
    const auto all = Release(3, 10, false).seams(1, 1, 10);
    const auto part = Release(3, 6, false).seams(1, 1, 6);
    ASSERT_EQ(all.size(), 1u);
    ASSERT_EQ(part.size(), 1u);
    for (std::size_t k = 0; k < part[0].after.size(); ++k)
        EXPECT_EQ(part[0].after[k], all[0].after[k]) << k;
}

TEST(ReleaseSeam, IsMirroredWhenWalkedBackwards) {
    const auto seams = Release(1, 8, true).seams(10, 1, 10);
    ASSERT_EQ(seams.size(), 1u);
    EXPECT_GT(shown_after(seams[0], 8), 0.8f) << "stretched where it was let go";
    for (int f = 7; f >= 1; --f)
        EXPECT_LE(shown_after(seams[0], f), shown_after(seams[0], f + 1)) << f;
    EXPECT_LT(shown_after(seams[0], 1), 0.9f);
}

TEST(ReleaseSeam, HeldDrawingsChangeNothing) {
    Release release(3, 10, false);
    for (const int held : {6, 7})
        EXPECT_TRUE(release.store.put({0, held, AnalysisKind::kHeldBetween}, encode(1.0f)));
    const auto seams = release.seams(1, 1, 10);
    ASSERT_EQ(seams.size(), 1u);
    EXPECT_EQ(seams[0].after[3], seams[0].after[2]);
    EXPECT_EQ(seams[0].after[4], seams[0].after[2]);
}

}  // namespace
}  // namespace weft
