#include "engine/mask/left_behind.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

constexpr Size kIslandFrame{120, 80};
constexpr Recti kIsland{16, 14, 26, 24};
constexpr int kSquareStep_px = 4;

// A square moves to the right before a background that stands still, and an island of its matte is
// left on the background.
struct IslandWorld {
    std::uint8_t island_level = 200;  // of its pixels; the surface has 90
    int surface_px = kSquareStep_px;  // a frame
    int island_px = 0;                // a frame
    bool was_there = true;            // the island, on the frame before
    bool entered = false;             // it had come from outside
    bool looks_own = false;           // it has the surface's colours, but not those of its place
    int hidden_px = 0;                // of the surface's height
    LeftBehind left_behind;

    [[nodiscard]] static Recti surface(int t, int step_px) {
        const int x = 30 + t * step_px;
        return {x, 30, x + 40, 70};
    }
    [[nodiscard]] Recti island(int t) const {
        return {kIsland.x0 + t * island_px, kIsland.y0, kIsland.x1 + t * island_px, kIsland.y1};
    }

    static void fill(ImageF1& image, const Recti& where, float value) {
        for (int y = where.y0; y < where.y1; ++y) {
            for (int x = where.x0; x < where.x1; ++x)
                image.at(x, y) = value;
        }
    }

    // What is dropped on frame t.
    Matte advance(int t) {
        const Recti square = surface(t, surface_px), rest = island(t);
        ImageF1 phi(kIslandFrame, -9.0f), prev_phi(kIslandFrame, -9.0f),
            key_phi(kIslandFrame, -9.0f);
        fill(prev_phi, surface(t - 1, surface_px), 9);
        if (was_there) fill(prev_phi, island(t - 1), 3);
        Recti seen = square;
        seen.y0 += hidden_px;
        fill(phi, seen, 9);
        fill(phi, rest, 3);
        fill(key_phi, surface(0, surface_px), 9);
        ImageU8x3 frame(kIslandFrame, 40), key(kIslandFrame, 90);
        ImageU8x3 painted(kIslandFrame, 40);
        for (int y = 0; y < kIslandFrame.height; ++y)
            for (int x = 0; x < kIslandFrame.width; ++x)
                for (int c = 0; c < 3 && key_phi.at(x, y) > 0; ++c)
                    painted.at(x, y, c) = looks_own && x % 2 == 0 ? island_level : 90;
        const SurfacePalette palette(painted, key_phi);
        FlowField flow(kIslandFrame);
        ImageF2 still(kIslandFrame), key_from_cur(kIslandFrame);
        for (int y = 0; y < kIslandFrame.height; ++y) {
            for (int x = 0; x < kIslandFrame.width; ++x) {
                // Outside, and of the island, a place in the middle of the surface.
                key_from_cur.pixel(x, y)[0] = key_from_cur.pixel(x, y)[1] = 50;
                const bool on_square = square.contains(x, y), on_rest = rest.contains(x, y);
                if (on_square) key_from_cur.pixel(x, y)[0] = static_cast<float>(x - t * surface_px);
                if (on_square) key_from_cur.pixel(x, y)[1] = static_cast<float>(y);
                flow.d.pixel(x, y)[0] =
                    static_cast<float>(on_square ? -surface_px : (on_rest ? -island_px : 0));
                for (int c = 0; c < 3 && (on_square || on_rest); ++c)
                    frame.at(x, y, c) = on_square ? std::uint8_t{90} : island_level;
            }
        }
        Matte came(kIslandFrame);
        for (int y = rest.y0; y < rest.y1 && entered; ++y)
            std::fill(came.row(y) + rest.x0, came.row(y) + rest.x1, std::uint8_t{255});
        return left_behind.advance(
            {frame, phi, prev_phi, came, flow, still, key, key_phi, palette, key_from_cur, 1});
    }
};

TEST(LeftBehind, AnIslandThatMovesWithTheBackgroundIsDroppedAfterThreeFrames) {
    IslandWorld w;
    EXPECT_TRUE(w.advance(1).empty());
    EXPECT_TRUE(w.advance(2).empty());
    const Matte dropped = w.advance(3);
    ASSERT_FALSE(dropped.empty());
    for (int y = 0; y < kIslandFrame.height; ++y) {
        for (int x = 0; x < kIslandFrame.width; ++x)
            EXPECT_EQ(dropped.at(x, y) != 0, kIsland.contains(x, y)) << x << ", " << y;
    }
}

void expect_kept(IslandWorld w) {
    for (int t = 1; t <= 8; ++t)
        EXPECT_TRUE(w.advance(t).empty()) << t;
}

TEST(LeftBehind, OneThatLooksLikeItsPlaceOnTheKeyframeStays) {
    IslandWorld w;
    w.island_level = 94;
    expect_kept(w);
}

TEST(LeftBehind, OneThatMovesWithTheSurfaceStays) {
    IslandWorld w;
    w.island_px = kSquareStep_px;
    expect_kept(w);
}

TEST(LeftBehind, NothingIsSaidWhereTheSurfaceMovesAsTheBackground) {
    IslandWorld w;
    w.surface_px = 0;
    expect_kept(w);
}

TEST(LeftBehind, AMoveBeginsTheCountAgain) {
    IslandWorld w;
    EXPECT_TRUE(w.advance(1).empty());
    EXPECT_TRUE(w.advance(2).empty());
    w.island_px = 1;  // for one frame
    EXPECT_TRUE(w.advance(3).empty());
    w.island_px = 0;
    EXPECT_TRUE(w.advance(4).empty());
    EXPECT_TRUE(w.advance(5).empty());
}

// A shade that leaves the coat behind a sleeve makes a piece of it look like the sleeve.
TEST(LeftBehind, AnIslandThatWasOutsideBeforeIsDroppedAtOnce) {
    IslandWorld w;
    w.was_there = false;
    const Matte dropped = w.advance(1);
    ASSERT_FALSE(dropped.empty());
    EXPECT_NE(dropped.at(kIsland.x0 + 3, kIsland.y0 + 3), 0);
    EXPECT_EQ(dropped.at(60, 50), 0);
    // What was hidden comes back as it was.
    w.island_level = 94;
    EXPECT_TRUE(w.advance(2).empty());
}

// The other sleeve of a coat, that comes into view beside the first.
TEST(LeftBehind, ATwinThatCameFromOutsideIsDropped) {
    IslandWorld w;
    w.looks_own = true;
    w.island_px = kSquareStep_px;
    EXPECT_TRUE(w.advance(1).empty()) << "it was there from the first";
    w.entered = true;
    const Matte dropped = w.advance(2);
    ASSERT_FALSE(dropped.empty());
    EXPECT_NE(dropped.at(kIsland.x0 + 3 + 2 * kSquareStep_px, kIsland.y0 + 3), 0);
    EXPECT_EQ(dropped.at(70, 60), 0);
}

// What was behind something comes back beside it.
TEST(LeftBehind, ItStaysIfAsMuchOfTheSurfaceIsMissing) {
    IslandWorld w;
    w.looks_own = w.entered = true;
    w.island_px = kSquareStep_px;
    w.hidden_px = 20;
    expect_kept(w);
}

}  // namespace
}  // namespace weft
