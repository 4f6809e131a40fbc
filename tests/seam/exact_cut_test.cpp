// Both own solvers against brute force and against OpenCV's max-flow.

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
// After core.hpp, which it does not include itself.
#include <opencv2/imgproc/detail/gcgraph.hpp>
#include <vector>

#include "engine/seam/seam.h"
#include "tests/seam/random_problems.h"

namespace weft::test {
namespace {

constexpr Costs kAllCosts[] = {Costs::kDistinct, Costs::kTies, Costs::kZeros};

int count_old(const SeamProblem& p, const Image<std::uint8_t, 1>& labels) {
    int old = 0;
    for (int y = 0; y < p.cells.height(); ++y) {
        for (int x = 0; x < p.cells.width(); ++x) {
            old += p.cells.at(x, y) != SeamCell::kOutside && labels.at(x, y) == 0;
        }
    }
    return old;
}

bool keeps_ties(const SeamProblem& p, const Image<std::uint8_t, 1>& labels) {
    for (int y = 0; y < p.cells.height(); ++y) {
        for (int x = 0; x < p.cells.width(); ++x) {
            const SeamCell c = p.cells.at(x, y);
            if (c == SeamCell::kNew && labels.at(x, y) != 1) return false;
            if (c != SeamCell::kNew && c != SeamCell::kFree && labels.at(x, y) != 0) return false;
        }
    }
    return true;
}

// Every labelling of the free pixels: the smallest energy, and of those the fewest old pixels.
struct BruteForce {
    std::int64_t energy = std::numeric_limits<std::int64_t>::max();
    Image<std::uint8_t, 1> labels;
};

BruteForce brute_force(const SeamProblem& p) {
    std::vector<Vec2i> free_pixels;
    Image<std::uint8_t, 1> labels(p.cells.size(), 0);
    for (int y = 0; y < p.cells.height(); ++y) {
        for (int x = 0; x < p.cells.width(); ++x) {
            if (p.cells.at(x, y) == SeamCell::kFree) free_pixels.push_back({x, y});
            if (p.cells.at(x, y) == SeamCell::kNew) labels.at(x, y) = 1;
        }
    }
    BruteForce best;
    for (std::uint32_t bits = 0; bits < (1u << free_pixels.size()); ++bits) {
        for (std::size_t i = 0; i < free_pixels.size(); ++i) {
            labels.at(free_pixels[i].x, free_pixels[i].y) = (bits >> i) & 1;
        }
        const std::int64_t e = seam_energy(p, labels);
        if (e < best.energy ||
            (e == best.energy && count_old(p, labels) < count_old(p, best.labels))) {
            best = {e, labels};
        }
    }
    return best;
}

std::int64_t opencv_value(const SeamProblem& p) {
    using Weight = double;  // Sums stay far below 2^53: exact.
    const int w = p.cells.width(), h = p.cells.height();
    cv::detail::GCGraph<Weight> graph(static_cast<unsigned>(w * h),
                                      static_cast<unsigned>(4 * w * h));
    const Weight tie = 1e12;
    Weight constant = 0;
    for (int i = 0; i < w * h; ++i)
        graph.addVtx();
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const SeamCell c = p.cells.at(x, y);
            if (c == SeamCell::kOutside) continue;
            const Weight o = p.old_cost.empty() ? 0 : p.old_cost.at(x, y);
            const Weight n = p.new_cost.empty() ? 0 : p.new_cost.at(x, y);
            if (c == SeamCell::kFree) {
                graph.addTermWeights(y * w + x, n, o);
            } else {
                constant += c == SeamCell::kOld ? o : n;
                graph.addTermWeights(y * w + x, c == SeamCell::kOld ? tie : 0,
                                     c == SeamCell::kNew ? tie : 0);
            }
            if (x + 1 < w && p.cells.at(x + 1, y) != SeamCell::kOutside) {
                graph.addEdges(y * w + x, y * w + x + 1, p.right.at(x, y), p.right.at(x, y));
            }
            if (y + 1 < h && p.cells.at(x, y + 1) != SeamCell::kOutside) {
                graph.addEdges(y * w + x, (y + 1) * w + x, p.down.at(x, y), p.down.at(x, y));
            }
        }
    }
    return static_cast<std::int64_t>(graph.maxFlow() + constant);
}

void expect_exact(const SeamProblem& p, const SeamResult& r) {
    EXPECT_EQ(r.energy, seam_energy(p, r.labels));
    EXPECT_TRUE(keeps_ties(p, r.labels));
    EXPECT_GT(r.graph_bytes, 0u);
}

// Returns whether the planar solver took part.
bool expect_same(const SeamProblem& p) {
    const SeamResult flow = solve_grid_maxflow(p);
    expect_exact(p, flow);
    const auto planar = solve_planar_dual(p);
    if (!planar) return false;
    expect_exact(p, *planar);
    EXPECT_EQ(planar->energy, flow.energy);
    EXPECT_EQ(planar->labels, flow.labels);
    return true;
}

TEST(ExactCut, EqualsBruteForceOnSmallGrids) {
    Rng rng(1);
    int planar = 0;
    for (int i = 0; i < 600; ++i) {
        const Costs costs = kAllCosts[i % 3];
        SeamProblem p = i % 2 ? soup(4, 4, rng, costs) : strip(5, 3, rng, costs);
        if (i % 5 == 0) draw_data(p, rng, costs);
        const BruteForce truth = brute_force(p);
        const SeamResult flow = solve_grid_maxflow(p);
        ASSERT_EQ(flow.energy, truth.energy) << i;
        ASSERT_EQ(flow.labels, truth.labels) << i;
        if (const auto dual = solve_planar_dual(p)) {
            ++planar;
            ASSERT_EQ(dual->energy, truth.energy) << i;
            ASSERT_EQ(dual->labels, truth.labels) << i;
        }
    }
    EXPECT_GT(planar, 200);
}

TEST(ExactCut, PlanarDualEqualsMaxFlowOnStrips) {
    Rng rng(2);
    for (int i = 0; i < 3000; ++i) {
        const int w = 2 + static_cast<int>(rng.below(14)), h = 1 + static_cast<int>(rng.below(24));
        ASSERT_TRUE(expect_same(strip(w, h, rng, kAllCosts[i % 3]))) << i;
    }
}

TEST(ExactCut, PlanarDualEqualsMaxFlowOnLShapes) {
    Rng rng(3);
    int planar = 0;
    for (int i = 0; i < 2000; ++i) {
        const int w = 12 + static_cast<int>(rng.below(16)),
                  h = 12 + static_cast<int>(rng.below(16));
        const int left = 2 + static_cast<int>(rng.below(6)),
                  top = 2 + static_cast<int>(rng.below(6));
        planar += expect_same(l_shape(w, h, left, top, 0, rng, kAllCosts[i % 3]));
    }
    EXPECT_EQ(planar, 2000);
}

TEST(ExactCut, PlanarDualEqualsMaxFlowOnRaggedOverlapsAndBlobs) {
    Rng rng(4);
    int ragged = 0, blobs = 0;
    for (int i = 0; i < 2000; ++i) {
        ragged += expect_same(l_shape(20, 20, 4, 4, 5, rng, kAllCosts[i % 3]));
        blobs += expect_same(blob(9, 9, 10 + i % 40, rng, kAllCosts[i % 3]));
    }
    EXPECT_GT(ragged, 1000);
    EXPECT_GT(blobs, 100);
}

TEST(ExactCut, MaxFlowEqualsOpenCv) {
    Rng rng(5);
    for (int i = 0; i < 900; ++i) {
        const Costs costs = kAllCosts[i % 3];
        SeamProblem p = i % 9 < 3   ? l_shape(24, 20, 5, 6, i % 4, rng, costs)
                        : i % 9 < 6 ? annulus(20, 18, 3 + i % 4, rng, costs)
                                    : soup(16, 16, rng, costs);
        if (i % 2) draw_data(p, rng, costs);
        const SeamResult flow = solve_grid_maxflow(p);
        expect_exact(p, flow);
        ASSERT_EQ(flow.energy, opencv_value(p)) << i;
    }
}

// A block whose whole border is old over old seams: data terms pull parts of its inside to the new
// side, as in refinement. Its graph has no two arcs, so that it is a max-flow's.
TEST(ExactCut, InteriorPatchesEqualOpenCv) {
    Rng rng(7);
    int laid = 0;
    for (int i = 0; i < 400; ++i) {
        SeamProblem p = empty_problem(18, 16);
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 18; ++x) {
                const bool border = x == 0 || y == 0 || x == 17 || y == 15;
                p.cells.at(x, y) = border ? SeamCell::kOld : SeamCell::kFree;
            }
        }
        draw_arcs(p, rng, Costs::kTies);
        p.old_cost = p.new_cost = Image<std::int32_t, 1>(p.cells.size(), 0);
        const int seam = 4 + static_cast<int>(rng.below(10));
        for (int y = 0; y < 16; ++y)
            p.old_cost.at(seam, y) = static_cast<std::int32_t>(rng.below(i % 3 ? 12 : 3));
        EXPECT_FALSE(solve_planar_dual(p));
        const SeamResult cut = solve_seam(p);
        expect_exact(p, cut);
        ASSERT_EQ(cut.energy, opencv_value(p)) << i;
        ASSERT_LE(cut.energy, solve_direct(p).energy);
        laid += count_old(p, cut.labels) < 18 * 16;
    }
    EXPECT_GT(laid, 100);
    EXPECT_LT(laid, 400);
}

TEST(ExactCut, LargestCostsDoNotOverflow) {
    Rng rng(6);
    SeamProblem p = strip(8, 40, rng, Costs::kDistinct);
    constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
    p.right = p.down = Image<std::int32_t, 1>(p.cells.size(), kMost);
    ASSERT_TRUE(expect_same(p));
    EXPECT_EQ(solve_seam(p).energy, 40ll * kMost);
}

}  // namespace
}  // namespace weft::test
