// Which solver takes which shape, and the cut against the baselines.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "engine/seam/seam.h"
#include "tests/seam/random_problems.h"

namespace weft::test {
namespace {

TEST(SeamShapes, PlanarDualRefusesWhatItCannotDo) {
    Rng rng(11);
    EXPECT_FALSE(solve_planar_dual(annulus(16, 16, 4, rng, Costs::kTies)));
    SeamProblem with_data = strip(6, 6, rng, Costs::kTies);
    draw_data(with_data, rng, Costs::kTies);
    EXPECT_FALSE(solve_planar_dual(with_data));

    SeamProblem two_parts = strip(6, 7, rng, Costs::kTies);
    for (int x = 0; x < 6; ++x)
        two_parts.cells.at(x, 3) = SeamCell::kOutside;
    EXPECT_FALSE(solve_planar_dual(two_parts));

    SeamProblem two_arcs = strip(6, 6, rng, Costs::kTies);
    two_arcs.cells.at(5, 2) = SeamCell::kOld;
    EXPECT_FALSE(solve_planar_dual(two_arcs));

    SeamProblem island = strip(7, 7, rng, Costs::kTies);
    island.cells.at(3, 3) = SeamCell::kNew;
    EXPECT_FALSE(solve_planar_dual(island));

    SeamProblem untied = empty_problem(4, 4);
    untied.cells = Image<SeamCell, 1>(4, 4, SeamCell::kFree);
    EXPECT_FALSE(solve_planar_dual(untied));
    EXPECT_FALSE(solve_planar_dual(empty_problem(4, 4)));
}

TEST(SeamShapes, UShapeIsPlanarAndAnnulusIsSolvedByMaxFlow) {
    Rng rng(12);
    Image<std::uint8_t, 1> filled(22, 22, 0);
    for (int y = 0; y < 22; ++y) {
        for (int x = 0; x < 22; ++x)
            filled.at(x, y) = x < 6 || x >= 16 || y < 6 ? 1 : 0;
    }
    const SeamProblem u = overlap_of(filled, rng, Costs::kDistinct);
    ASSERT_TRUE(solve_planar_dual(u));
    EXPECT_EQ(solve_planar_dual(u)->labels, solve_grid_maxflow(u).labels);

    const SeamProblem ring = annulus(18, 18, 5, rng, Costs::kDistinct);
    EXPECT_EQ(solve_seam(ring).energy, solve_grid_maxflow(ring).energy);
}

TEST(SeamShapes, CutFollowsTheOnlyCheapPath) {
    Rng rng(13);
    SeamProblem p = strip(9, 9, rng, Costs::kDistinct);
    p.right = p.down = Image<std::int32_t, 1>(9, 9, 1000);
    // A staircase that turns back on itself, which no monotone boundary follows.
    const int column[9] = {2, 2, 6, 6, 1, 1, 5, 5, 3};
    for (int y = 0; y < 9; ++y) {
        p.right.at(column[y], y) = 1;
        if (y == 0) continue;
        const int a = std::min(column[y], column[y - 1]), b = std::max(column[y], column[y - 1]);
        for (int x = a + 1; x <= b; ++x)
            p.down.at(x, y - 1) = 1;
    }
    const SeamResult r = solve_seam(p);
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 9; ++x)
            EXPECT_EQ(r.labels.at(x, y), x > column[y] ? 1 : 0);
    }
}

TEST(SeamShapes, CutIsNeverAboveTheBaselines) {
    Rng rng(14);
    int strictly_below_dp = 0;
    for (int i = 0; i < 600; ++i) {
        const Costs costs = i % 2 ? Costs::kDistinct : Costs::kZeros;
        const SeamProblem p = i % 3 == 0   ? strip(12, 30, rng, costs)
                              : i % 3 == 1 ? l_shape(30, 30, 8, 9, i % 5, rng, costs)
                                           : annulus(24, 24, 7, rng, costs);
        const SeamResult cut = solve_seam(p), dp = solve_min_error_boundary(p),
                         direct = solve_direct(p);
        EXPECT_EQ(dp.energy, seam_energy(p, dp.labels));
        EXPECT_EQ(direct.energy, seam_energy(p, direct.labels));
        EXPECT_LE(cut.energy, dp.energy);
        EXPECT_LE(cut.energy, direct.energy);
        strictly_below_dp += cut.energy < dp.energy;
        if (i % 3 == 0) {
            EXPECT_LE(dp.energy, direct.energy) << i;
        }
    }
    EXPECT_GT(strictly_below_dp, 200);
}

TEST(SeamShapes, MinErrorBoundaryIsTheBestMonotoneBoundaryOfAStrip) {
    Rng rng(15);
    for (int i = 0; i < 50; ++i) {
        const SeamProblem p = strip(4, 4, rng, Costs::kDistinct);
        std::int64_t best = std::numeric_limits<std::int64_t>::max();
        for (int code = 0; code < 81; ++code) {
            Image<std::uint8_t, 1> labels(4, 4, 0);
            for (int y = 0, c = code; y < 4; ++y, c /= 3) {
                for (int x = 1 + c % 3; x < 4; ++x)
                    labels.at(x, y) = 1;
            }
            best = std::min(best, seam_energy(p, labels));
        }
        EXPECT_EQ(solve_min_error_boundary(p).energy, best) << i;
    }
}

TEST(SeamShapes, OfEqualCutsTheOneWithFewestOldPixelsIsTaken) {
    SeamProblem p = empty_problem(6, 2);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 6; ++x) {
            p.cells.at(x, y) = x == 0 ? SeamCell::kOld : x == 5 ? SeamCell::kNew : SeamCell::kFree;
        }
    }
    p.right = Image<std::int32_t, 1>(6, 2, 7);
    for (const SeamResult& r : {*solve_planar_dual(p), solve_grid_maxflow(p)}) {
        EXPECT_EQ(r.energy, 14);
        for (int y = 0; y < 2; ++y) {
            for (int x = 0; x < 6; ++x)
                EXPECT_EQ(r.labels.at(x, y), x > 0);
        }
    }
}

}  // namespace
}  // namespace weft::test
