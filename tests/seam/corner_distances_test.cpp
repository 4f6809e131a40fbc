// Distances by passes against Dijkstra's algorithm, reachability against a plain flood, and seams
// under every instruction set.

#include <gtest/gtest.h>

#include <vector>

#include "engine/core/rng.h"
#include "engine/seam/bit_flood.h"
#include "engine/seam/corner_grid.h"

namespace weft::test {
namespace {

// `walls` of 16 steps are closed.
CornerGrid random_grid(Size pixels, int walls, std::uint64_t most, Rng& rng) {
    CornerGrid grid(pixels);
    const auto cost = [&] {
        return rng.below(16) < static_cast<std::uint64_t>(walls)
                   ? CornerGrid::kWall
                   : static_cast<std::uint32_t>(rng.below(most));
    };
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) {
            const auto i = static_cast<std::size_t>(grid.index(x, y));
            if (x + 1 < grid.width) grid.right[i] = cost();
            if (y + 1 < grid.height) grid.down[i] = cost();
        }
    }
    return grid;
}

TEST(CornerDistances, PassesEqualDijkstra) {
    Rng rng(1);
    int reached = 0, mazes = 0;
    for (int i = 0; i < 2000; ++i) {
        const Size pixels{1 + static_cast<int>(rng.below(20)), 1 + static_cast<int>(rng.below(20))};
        // Many walls make mazes, where ways turn back again and again.
        const int walls = i % 7;
        const CornerGrid grid = random_grid(pixels, walls, i % 3 ? 1000 : 2, rng);
        const auto corner = [&] {
            return grid.index(static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.width))),
                              static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.height))));
        };
        const CornerGroup start{corner(), corner()}, end{corner(), corner()};
        std::vector<CornerGroup> groups;
        if (i % 2) groups.push_back({corner(), corner(), corner()});
        const CornerDistances truth = distances_by_heap(grid, start, end, groups);
        const CornerDistances passes = distances_by_passes(grid, start, end, groups);
        if (truth.to_end == CornerDistances::kUnreachable) {
            EXPECT_TRUE(passes.distance.empty()) << i;
            continue;
        }
        ++reached;
        mazes += walls > 4;
        ASSERT_EQ(passes.to_end, truth.to_end) << i;
        for (int y = 0; y < grid.height; ++y) {
            for (int x = 0; x < grid.width; ++x) {
                const auto at = static_cast<std::size_t>(grid.index(x, y));
                ASSERT_EQ(passes.distance[at], truth.distance[at]) << i << ": " << x << "," << y;
            }
        }
    }
    EXPECT_GT(reached, 1000);
    EXPECT_GT(mazes, 100);
}

TEST(CornerDistances, WhatDoesNotFitThirtyBitsIsLeftToDijkstra) {
    CornerGrid grid({1, 3});
    for (int y = 0; y < 3; ++y)
        grid.down[static_cast<std::size_t>(grid.index(0, y))] = 0x7FFFFFFFu;
    const CornerGroup start{grid.index(0, 0)}, end{grid.index(0, 3)};
    EXPECT_TRUE(distances_by_passes(grid, start, end, {}).distance.empty());
    EXPECT_EQ(corner_distances(grid, start, end, {}).to_end, 3ull * 0x7FFFFFFF);
}

TEST(BitFlood, ReachesWhatAPlainFloodReaches) {
    Rng rng(2);
    for (int i = 0; i < 400; ++i) {
        const Size s{1 + static_cast<int>(rng.below(150)), 1 + static_cast<int>(rng.below(12))};
        FloodSteps steps(s);
        BitRows reached(s);
        const auto get = [](const BitRows& rows, int x, int y) {
            return (rows.row(y)[x / 64] >> (x % 64) & 1) != 0;
        };
        const auto set = [](BitRows& rows, int x, int y) {
            rows.row(y)[x / 64] |= std::uint64_t{1} << (x % 64);
        };
        std::vector<Vec2i> stack;
        Image<std::uint8_t, 1> truth(s, 0);
        for (int y = 0; y < s.height; ++y) {
            for (int x = 0; x < s.width; ++x) {
                if (x + 1 < s.width && rng.below(8) > 1) set(steps.right, x, y);
                if (x > 0 && rng.below(8) > 3) set(steps.left, x, y);
                if (y + 1 < s.height && rng.below(8) > 3) set(steps.down, x, y);
                if (y > 0 && rng.below(8) > 4) set(steps.up, x, y);
                if (rng.below(200) == 0) {
                    set(reached, x, y);
                    truth.at(x, y) = 1;
                    stack.push_back({x, y});
                }
            }
        }
        while (!stack.empty()) {
            const Vec2i c = stack.back();
            stack.pop_back();
            const auto go = [&](const BitRows& rows, Vec2i to) {
                if (!get(rows, c.x, c.y) || truth.at(to.x, to.y)) return;
                truth.at(to.x, to.y) = 1;
                stack.push_back(to);
            };
            go(steps.right, {c.x + 1, c.y});
            go(steps.left, {c.x - 1, c.y});
            go(steps.down, {c.x, c.y + 1});
            go(steps.up, {c.x, c.y - 1});
        }
        flood(steps, reached);
        for (int y = 0; y < s.height; ++y) {
            for (int x = 0; x < s.width; ++x)
                ASSERT_EQ(get(reached, x, y), truth.at(x, y) != 0) << i << ": " << x << "," << y;
        }
    }
}

}  // namespace
}  // namespace weft::test
