// The way back through a grid warp.
#include "engine/core/plane_warp.h"

#include <gtest/gtest.h>

#include <chrono>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "engine/core/texture_mapping.h"
#include "tests/core/warp_box.h"

namespace weft {
namespace {

using glm::dvec2;

GridWarp strong(double falloff_px) {
    GridWarp warp = grid_over(kBox, 3, 2);
    warp.points[warp.index(1, 1)].at += dvec2(38, 25);
    warp.points[warp.index(2, 1)].at += dvec2(-18, 30);
    warp.points[warp.index(3, 0)].at += dvec2(20, -16);
    warp.points[warp.index(0, 2)].left = dvec2(-45, 20);
    warp.falloff_px = falloff_px;
    return warp;
}

TEST(PlaneWarp, UndoesTheWarpEverywhere) {
    for (const double falloff : {0.0, 60.0}) {
        const GridWarp warp = strong(falloff);
        ASSERT_TRUE(check_grid_warp(warp)) << check_grid_warp(warp).error().text();
        const WarpNet net(warp, warp.points);
        const PlaneWarp back(warp, 0);
        double most = 0;
        for (float y = -300; y < 600; y += 2.3f)
            for (float x = -300; x < 800; x += 2.9f)
                most = std::max(most,
                                glm::distance(net.moved(dvec2(back.rest({x, y}))).at, dvec2(x, y)));
        EXPECT_LT(most, 5e-4) << falloff;
    }
}

// Near a fold the way back is steep, and a plain Newton step leaves the neighbourhood.
TEST(PlaneWarp, FindsItsWayCloseToAFold) {
    GridWarp warp = grid_over(kBox, 3, 3);
    std::vector<WarpPoint> wanted = warp.points;
    wanted[5].at += dvec2(150, 90);
    wanted[6].at += dvec2(-60, 40);
    const double share =
        0.999 * WarpNet(warp, warp.points).unfolded_towards(WarpNet(warp, wanted)).share;
    ASSERT_LT(share, 0.9);
    for (const std::size_t k : {5U, 6U})
        warp.points[k].at += share * (wanted[k].at - warp.points[k].at);
    ASSERT_TRUE(check_grid_warp(warp));
    const WarpNet net(warp, warp.points);
    const PlaneWarp back(warp, 0);
    double most = 0;
    for (float y = 40; y < 260; y += 0.7f)
        for (float x = 90; x < 410; x += 0.9f)
            most =
                std::max(most, glm::distance(net.moved(dvec2(back.rest({x, y}))).at, dvec2(x, y)));
    EXPECT_LT(most, 2e-3);
}

TEST(PlaneWarp, IsTheSameForAnyNumberOfThreads) {
    const GridWarp warp = strong(40);
    std::vector<Vec2> before;
    for (const int threads : {1, 4}) {
        set_thread_count(threads);
        const PlaneWarp back(warp, 0);
        std::vector<Vec2> now;
        for (float y = 0; y < 300; y += 7)
            for (float x = 0; x < 500; x += 7)
                now.push_back(back.rest({x, y}));
        if (!before.empty()) {
            EXPECT_EQ(now, before);
        }
        before = now;
    }
    set_thread_count(0);
}

TEST(PlaneWarp, ActsBeneathThePlacementAndOnSmallerFramesToo) {
    const auto warp = std::make_shared<const PlaneWarp>(strong(0), 0);
    Mat3 half(1);
    half[0][0] = half[1][1] = 0.5f;
    const TextureMapping mapping = TextureMapping(half).with_warp(warp);
    const Vec2 at(233, 160);
    EXPECT_EQ(mapping.texel(at), 0.5f * warp->rest(at));
    const Vec2 small = mapping.on_smaller_frame(2).texel(at / 2.0f);
    EXPECT_LT(glm::distance(small, mapping.texel(at)), 1e-3f);
    // The local scale of the warp reaches what filters by it.
    const TextureMapping::Linear here = mapping.linear_at(at);
    const Vec2 step = mapping.texel(at + Vec2(1, 0)) - mapping.texel(at - Vec2(1, 0));
    EXPECT_LT(glm::distance(here.step({2, 0}), step), 0.02f);
    EXPECT_GT(glm::distance(here.step({2, 0}), Vec2(1, 0)), 0.05f);
}

TEST(PlaneWarp, IsFastEnoughForEveryPixel) {
    const GridWarp warp = strong(0);
    const PlaneWarp back(warp, 0);
    const auto begin = std::chrono::steady_clock::now();
    Vec2 sum(0, 0);
    for (int y = 0; y < 300; ++y)
        for (int x = 0; x < 500; ++x)
            sum += back.rest({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
    const double ns =
        std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() /
        (300 * 500);
    RecordProperty("ns_per_pixel", static_cast<int>(ns));
    EXPECT_GT(sum.x, 0);
    EXPECT_LT(ns, 20'000) << "even without optimisation, in a sanitised build on a busy machine";
}

}  // namespace
}  // namespace weft
