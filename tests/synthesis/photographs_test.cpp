#include <gtest/gtest.h>

#include "engine/seam/seam_cost.h"
#include "tests/seam/random_problems.h"
#include "tests/synthesis/photographs.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

TEST(Photographs, BothExactSolversGiveOneCutBelowTheBaselines) {
    const auto paths = photographs();
    if (paths.empty()) GTEST_SKIP() << "the texture photographs are not there";
    Rng rng(1);
    for (std::size_t i = 0; i < paths.size(); i += 12) {
        SCOPED_TRACE(paths[i]);
        const ImageU8x3 photo = load_photograph(paths[i], 192);
        const ViewU8x3 a = photo.view().crop({0, 0, 96, 96});
        const ViewU8x3 b = photo.view().crop({70, 60, 166, 156});
        SeamProblem l = l_shape(96, 96, 36, 30, 0, rng, Costs::kZeros);
        fill_seam_costs(a, b, l);
        SeamProblem s = strip(36, 96, rng, Costs::kZeros);
        fill_seam_costs(a.crop({0, 0, 36, 96}), b.crop({0, 0, 36, 96}), s);
        for (const SeamProblem* p : {&l, &s}) {
            const auto dual = solve_planar_dual(*p);
            const SeamResult flow = solve_grid_maxflow(*p);
            ASSERT_TRUE(dual);
            EXPECT_EQ(dual->energy, flow.energy);
            EXPECT_EQ(dual->labels, flow.labels);
            EXPECT_LE(flow.energy, solve_min_error_boundary(*p).energy);
            EXPECT_LE(flow.energy, solve_direct(*p).energy);
        }
    }
}

TEST(Photographs, EveryTwelfthIsFilledAndRecounts) {
    const auto paths = photographs();
    if (paths.empty()) GTEST_SKIP() << "the texture photographs are not there";
    for (std::size_t i = 0; i < paths.size(); i += 12) {
        SCOPED_TRACE(paths[i]);
        const ImageU8x3 sample = load_photograph(paths[i], i % 24 ? 0 : 96);
        PlaneOptions o;
        o.size = {256, 256};
        o.tileable = true;
        const auto plane = grow_plane(sample, o);
        ASSERT_TRUE(plane) << plane.error().text();
        expect_sound(sample, *plane, o);
    }
}

}  // namespace
}  // namespace weft::test
