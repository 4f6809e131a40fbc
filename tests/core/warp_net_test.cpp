// The displacement of a grid warp: Bézier patches that join smoothly, and what is beyond the grid.
#include "engine/core/warp_net.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/core/warp_box.h"

namespace weft {
namespace {

using glm::dvec2;

const Quad<double> kDeeper{dvec2(100, 50), dvec2(400, 110), dvec2(380, 180), dvec2(90, 260)};

GridWarp bent_with_handles(const Quad<double>& corners, double falloff_px) {
    GridWarp warp = grid_over(corners, 3, 2);
    for (std::size_t k = 0; k < warp.points.size(); ++k)
        warp.points[k].at += dvec2(static_cast<double>(k * 7 % 5) - 2, k * 5 % 7) * 1.5;
    warp.points[5].right = dvec2(30, 12);
    warp.points[5].left = dvec2(-30, -12);
    warp.falloff_px = falloff_px;
    return warp;
}

TEST(WarpNet, AtRestNothingMoves) {
    for (const auto& corners : {kBox, kDeeper}) {
        const GridWarp warp = grid_over(corners, 3, 4);
        const WarpNet net(warp, warp.points);
        for (const dvec2 at : {dvec2(0, 0), dvec2(123, 77), dvec2(250, 150), dvec2(900, -500)}) {
            EXPECT_LT(glm::distance(net.moved(at).at, at), 1e-9);
            EXPECT_LT(glm::distance(net.moved(at).jacobian[0], dvec2(1, 0)), 1e-9);
        }
    }
}

TEST(WarpNet, PointsComeToLieWhereTheyArePut) {
    const GridWarp warp = bent_with_handles(kDeeper, 0), rest = grid_over(kDeeper, 3, 2);
    const WarpNet net(warp, warp.points);
    for (std::size_t k = 0; k < warp.points.size(); ++k)
        EXPECT_LT(glm::distance(net.moved(rest.points[k].at).at, warp.points[k].at), 1e-9) << k;
}

TEST(WarpNet, OnePatchWithOneCornerMovedIsBilinear) {
    GridWarp warp = grid_over(kBox, 1, 1);
    warp.points[3].at += dvec2(40, 20);
    const WarpNet net(warp, warp.points);
    EXPECT_LT(glm::distance(net.moved({250, 150}).at, dvec2(260, 155)), 1e-9);
    EXPECT_LT(glm::distance(net.moved({325, 100}).at, dvec2(325 + 7.5, 100 + 3.75)), 1e-9);
}

TEST(WarpNet, HandlesAreTangentsOfTheEdges) {
    const GridWarp warp = bent_with_handles(kBox, 0);
    const WarpNet net(warp, warp.points);
    // Three times the handle is the slope per column.
    const auto at = net.on_grid({1, 1});
    EXPECT_LT(glm::distance(at.by_column, 3.0 * dvec2(30, 12)), 1e-9);
    EXPECT_LT(glm::distance(net.on_grid({1 - 1e-9, 1}).by_column, 3.0 * dvec2(30, 12)), 1e-5);
}

// Differences across every line of the grid, the border, and the end of the fall-off.
TEST(WarpNet, IsDifferentiableEverywhereAndSaysItsDerivative) {
    for (const double falloff : {0.0, 60.0}) {
        for (const auto& corners : {kBox, kDeeper}) {
            const GridWarp warp = bent_with_handles(corners, falloff);
            const WarpNet net(warp, warp.points);
            double most = 0;
            for (double y = -60; y < 380; y += 3.7) {
                for (double x = -40; x < 540; x += 3.1) {
                    constexpr double kStep = 1e-4;
                    const auto here = net.moved({x, y});
                    for (int axis = 0; axis < 2; ++axis) {
                        const dvec2 step = axis == 0 ? dvec2(kStep, 0) : dvec2(0, kStep);
                        const dvec2 slope =
                            (net.moved(dvec2(x, y) + step).at - net.moved(dvec2(x, y) - step).at) /
                            (2 * kStep);
                        most = std::max(most, glm::distance(slope, here.jacobian[axis]));
                    }
                }
            }
            EXPECT_LT(most, 2e-5) << falloff;
        }
    }
}

TEST(WarpNet, FallOffEndsTheWarpAndOtherwiseItGoesOn) {
    const GridWarp warp = bent_with_handles(kBox, 60);
    const WarpNet fading(warp, warp.points);
    EXPECT_EQ(fading.moved({461, 150}).at, dvec2(461, 150));
    EXPECT_GT(glm::distance(fading.moved({420, 150}).at, dvec2(420, 150)), 1);
    const GridWarp on = bent_with_handles(kBox, 0);
    const WarpNet going(on, on.points);
    EXPECT_GT(glm::distance(going.moved({1400, 150}).at, dvec2(1400, 150)), 1);
    EXPECT_LT(glm::distance(going.moved({1400, 150}).at, dvec2(1400, 150)), 60);
}

TEST(WarpNet, StaysFiniteBeyondTheHorizonOfItsPerspective) {
    const GridWarp warp = bent_with_handles(kDeeper, 0);
    const WarpNet net(warp, warp.points);
    for (double x = 400; x < 20000; x *= 1.03) {
        const auto at = net.moved({x, 145});
        EXPECT_LT(glm::distance(at.at, dvec2(x, 145)), 200) << x;
        EXPECT_LT(std::abs(at.jacobian[0].x), 10) << x;
    }
}

}  // namespace
}  // namespace weft
