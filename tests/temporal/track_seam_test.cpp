#include "engine/temporal/track_seam.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

constexpr Size kCells{12, 10};

std::vector<TrackEvidence> frames_of(int count, float mismatch) {
    return std::vector<TrackEvidence>(static_cast<std::size_t>(count),
                                      {ImageF1(kCells, mismatch), ImageF1(kCells, 16.0f)});
}

// On how many cells and frames the label goes back to the track before.
int returns(const std::vector<Image<std::uint8_t, 1>>& labels) {
    int count = 0;
    for (std::size_t t = 1; t < labels.size(); ++t) {
        for (int k = 0; k < kCells.width * kCells.height; ++k)
            count += labels[t - 1].data()[k] > labels[t].data()[k];
    }
    return count;
}

TEST(TrackSeam, EveryPlaceChangesOnceAndOnlyInTheMiddle) {
    const auto labels = cut_between_tracks(frames_of(20, 40), {.lambda = 1, .seed = 3});
    ASSERT_EQ(labels.size(), 20u);
    EXPECT_EQ(returns(labels), 0);
    const auto shown = [&](std::size_t t) {
        return std::count(labels[t].data(), labels[t].data() + kCells.width * kCells.height, 1);
    };
    EXPECT_EQ(shown(0), 0);
    EXPECT_EQ(shown(19), kCells.width * kCells.height);
}

TEST(TrackSeam, APlaceChangesWhileItIsHidden) {
    auto frames = frames_of(20, 40);
    for (std::size_t t = 4; t < 7; ++t) {
        for (int y = 0; y < kCells.height; ++y) {
            for (int x = 0; x < kCells.width / 2; ++x)
                frames[t].mismatch.at(x, y) = frames[t].pixels.at(x, y) = 0;
        }
    }
    // What a change costs counts for more than when it is due.
    const auto labels = cut_between_tracks(frames, {.lambda = 100, .seed = 3});
    for (int y = 0; y < kCells.height; ++y) {
        for (int x = 0; x < kCells.width / 2 - 1; ++x) {
            EXPECT_EQ(labels[3].at(x, y), 0);
            EXPECT_EQ(labels[7].at(x, y), 1);
        }
    }
}

// Textures that differ strongly, few frames to change in, and a small surface: still no flash.
TEST(TrackSeam, AShortIntervalDoesNotFlash) {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        const auto labels = cut_between_tracks(frames_of(7, 60), {.lambda = 1, .seed = seed});
        const int all = kCells.width * kCells.height;
        int before = 0, most = 0;
        for (const auto& frame : labels) {
            const int now = static_cast<int>(std::count(frame.data(), frame.data() + all, 1));
            most = std::max(most, now - before);
            before = now;
        }
        most = std::max(most, all - before);
        EXPECT_LT(most, all / 2) << "seed " << seed;
    }
}

TEST(TrackSeam, TheSeamRunsWhereBothLookAlike) {
    auto frames = frames_of(9, 60);
    for (auto& frame : frames) {
        for (int y = 0; y < kCells.height; ++y)
            frame.mismatch.at(5, y) = frame.mismatch.at(6, y) = 0.1f;
        // The left is only seen early, the right only late.
        const bool early = &frame < &frames[4];
        for (int y = 0; y < kCells.height; ++y) {
            for (int x = 0; x < kCells.width; ++x) {
                if (early == (x > 6)) frame.mismatch.at(x, y) = frame.pixels.at(x, y) = 0;
            }
        }
    }
    const auto labels = cut_between_tracks(frames, {.lambda = 100, .seed = 1});
    for (int y = 0; y < kCells.height; ++y) {
        EXPECT_EQ(labels[3].at(2, y), 0);
        EXPECT_EQ(labels[4].at(9, y), 1);
    }
}

TEST(TrackSeam, IsTheSameForTheSameSeed) {
    const auto frames = frames_of(12, 30);
    const auto a = cut_between_tracks(frames, {.lambda = 1, .seed = 8});
    const auto b = cut_between_tracks(frames, {.lambda = 1, .seed = 8});
    for (std::size_t t = 0; t < a.size(); ++t)
        EXPECT_TRUE(std::equal(a[t].data(), a[t].data() + a[t].size_bytes(), b[t].data()));
}

LatticeField constant(Vec2 d) {
    LatticeField field({64, 48}, 8);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i)
            field.set_node(i, j, d);
    }
    return field;
}

TEST(SpreadDisagreement, SmallOnesSlideLargeOnesStay) {
    const Matte all(64, 48, 255);
    const TrackLayers small =
        spread_disagreement(constant({1, 0}), constant({3, 0}), 0.25f, 2.0f, all);
    EXPECT_FALSE(small.apart);
    EXPECT_EQ(small.before.at({20, 20}), (Vec2{1.5f, 0}));
    EXPECT_EQ(small.after.at({20, 20}), (Vec2{1.5f, 0}));

    const TrackLayers large =
        spread_disagreement(constant({1, 0}), constant({9, 0}), 0.25f, 2.0f, all);
    EXPECT_TRUE(large.apart);
    EXPECT_EQ(large.before.at({20, 20}), (Vec2{1, 0}));
    EXPECT_EQ(large.after.at({20, 20}), (Vec2{9, 0}));

    const TrackLayers unseen =
        spread_disagreement(constant({1, 0}), constant({9, 0}), 0.25f, 2.0f, Matte(64, 48));
    EXPECT_FALSE(unseen.apart) << "what the region does not show does not matter";
}

TEST(TrackSeam, SharesAreWholeButBesideTheSeam) {
    TrackSeam seam;
    seam.first = 10;
    seam.last = 12;
    seam.cell_px = 4;
    seam.origin = {100, 0};
    seam.after.emplace_back(8, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 4; x < 8; ++x)
            seam.after[0].at(x, y) = 1;
    }
    EXPECT_TRUE(seam.covers(11));
    EXPECT_FALSE(seam.covers(12));
    EXPECT_EQ(seam.share_after(11, {112, 8}), 0.0f);
    EXPECT_EQ(seam.share_after(11, {120, 8}), 1.0f);
    EXPECT_FLOAT_EQ(seam.share_after(11, {116, 8}), 0.5f);
    EXPECT_EQ(seam.share_after(11, {-500, 900}), 0.0f);
    EXPECT_EQ(seam.share_after(11, {900, -500}), 1.0f);
}

}  // namespace
}  // namespace weft
