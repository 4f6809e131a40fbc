// Grid warps as values: points over time, handles, resampling, what is refused, and their text.
#include "engine/core/grid_warp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/core/warp_net.h"
#include "tests/core/warp_box.h"

namespace weft {
namespace {

using glm::dvec2;
using ::testing::HasSubstr;

const Quad<double> kDeep{dvec2(100, 50), dvec2(400, 90), dvec2(380, 200), dvec2(90, 260)};

GridWarp bent(const Quad<double>& corners = kBox, int columns = 3, int rows = 2) {
    GridWarp warp = grid_over(corners, columns, rows);
    for (std::size_t k = 0; k < warp.points.size(); ++k)
        warp.points[k].at += dvec2(static_cast<double>(k * 7 % 5) - 2, k * 5 % 7) * 2.0;
    return warp;
}

TEST(GridWarp, LiesAtRestOverItsCornersInTheirPerspective) {
    const GridWarp warp = grid_over(kDeep, 2, 2);
    EXPECT_TRUE(check_grid_warp(warp));
    EXPECT_NEAR(glm::distance(warp.points[0].at, kDeep[0]), 0, 1e-9);
    EXPECT_NEAR(glm::distance(warp.points[8].at, kDeep[2]), 0, 1e-9);
    // The diagonals of the quadrilateral meet where the middle of the rectangle is seen.
    const dvec2 a = kDeep[2] - kDeep[0], b = kDeep[3] - kDeep[1], c = kDeep[1] - kDeep[0];
    const double t = (c.x * b.y - c.y * b.x) / (a.x * b.y - a.y * b.x);
    EXPECT_NEAR(glm::distance(warp.points[4].at, kDeep[0] + t * a), 0, 1e-9);
}

TEST(GridWarp, KeysAreLinearBetweenAndConstantOutside) {
    GridWarp warp = bent();
    std::vector<WarpPoint> later = warp.points;
    later[5].at += dvec2(8, -4);
    later[5].right = dvec2(50, 10);
    set_key(warp, 20, later);
    set_key(warp, 10, warp.points);
    ASSERT_EQ(warp.keys.size(), 2U);
    EXPECT_EQ(warp.keys.front().first, 10);
    EXPECT_EQ(points_on(warp, 3), warp.points);
    EXPECT_EQ(points_on(warp, 99), later);
    const WarpPoint middle = points_on(warp, 15)[5];
    EXPECT_NEAR(glm::distance(middle.at, warp.points[5].at + dvec2(4, -2)), 0, 1e-12);
    // A handle that one key leaves to the neighbours is as those make it there.
    const dvec2 derived = *with_handles(warp, warp.points)[5].right;
    EXPECT_NEAR(glm::distance(*middle.right, 0.5 * (derived + dvec2(50, 10))), 0, 1e-12);
    EXPECT_FALSE(middle.left);
    set_key(warp, 20, warp.points);
    EXPECT_EQ(warp.keys.size(), 2U);
    EXPECT_EQ(points_on(warp, 20), warp.points);
}

TEST(GridWarp, HandlesFollowFromTheNeighbours) {
    GridWarp warp = grid_over(kBox, 3, 2);
    warp.points[warp.index(1, 1)].at.y += 30;
    const WarpPoint at = with_handles(warp, warp.points)[warp.index(1, 1)];
    EXPECT_NEAR(glm::distance(*at.right, dvec2(100.0 / 3, 0)), 0, 1e-9);
    EXPECT_NEAR(glm::distance(*at.left, dvec2(-100.0 / 3, 0)), 0, 1e-9);
    const WarpPoint beside = with_handles(warp, warp.points)[warp.index(2, 1)];
    EXPECT_NEAR(glm::distance(*beside.right, dvec2(100.0 / 3, -5)), 0, 1e-9);
}

TEST(GridWarp, ResamplingKeepsTheWarp) {
    for (const auto& corners : {kBox, kDeep}) {
        const GridWarp warp = bent(corners);
        const GridWarp finer = resampled(warp, 6, 4);
        ASSERT_TRUE(check_grid_warp(finer));
        const WarpNet a(warp, warp.points), b(finer, finer.points);
        for (double y = 60; y < 250; y += 13)
            for (double x = 105; x < 400; x += 17)
                EXPECT_LT(glm::distance(a.moved({x, y}).at, b.moved({x, y}).at), 0.6)
                    << x << "," << y;
        EXPECT_EQ(resampled(grid_over(corners, 3, 3), 5, 4).points.size(), 30U);
        for (const WarpPoint& point : resampled(grid_over(corners, 3, 3), 6, 6).points)
            EXPECT_FALSE(point.left || point.right || point.up || point.down);
    }
}

TEST(GridWarp, SmallerFramesHoldTheSameWarp) {
    GridWarp warp = bent();
    warp.falloff_px = 40;
    warp.points[5].up = dvec2(3, -30);
    set_key(warp, 4, warp.points);
    const GridWarp small = on_smaller_frame(warp, 2);
    const WarpNet a(warp, points_on(warp, 4)), b(small, points_on(small, 4));
    for (double x = 40; x < 460; x += 23)
        EXPECT_LT(glm::distance(a.moved({x, 120}).at / 2.0, b.moved({x / 2, 60}).at), 1e-9);
}

TEST(GridWarp, WhatFoldsIsRefusedWithThePlaceAndWhatToDo) {
    GridWarp warp = grid_over(kBox, 3, 2);
    warp.points[warp.index(1, 1)].at.x += 150;
    Status checked = check_grid_warp(warp);
    ASSERT_FALSE(checked);
    EXPECT_THAT(checked.error().text(), HasSubstr("folds at column"));
    EXPECT_THAT(checked.error().text(), HasSubstr("move the points or handles"));

    // Two keys that do not fold, and what lies between them does: a grid turned by half a turn.
    GridWarp turned = grid_over(kBox, 2, 2);
    turned.falloff_px = 0;
    std::vector<WarpPoint> back = turned.points;
    for (WarpPoint& point : back)
        point.at = dvec2(500, 300) - point.at;
    set_key(turned, 1, turned.points);
    set_key(turned, 9, back);
    checked = check_grid_warp(turned);
    ASSERT_FALSE(checked);
    EXPECT_THAT(checked.error().text(), HasSubstr("frame"));
}

TEST(GridWarp, ADragEndsBeforeTheFold) {
    const GridWarp warp = grid_over(kBox, 3, 3);
    std::vector<WarpPoint> wanted = warp.points;
    wanted[5].at.x += 180;
    const WarpNet from(warp, warp.points), to(warp, wanted);
    const auto found = from.unfolded_towards(to);
    ASSERT_GT(found.share, 0.1);
    ASSERT_LT(found.share, 0.9);
    GridWarp before = warp, after = warp;
    before.points[5].at.x += 180 * (found.share - 0.01);
    after.points[5].at.x += 180 * (found.share + 0.01);
    EXPECT_TRUE(check_grid_warp(before));
    EXPECT_FALSE(check_grid_warp(after));
}

TEST(GridWarp, HostileNumbersAreRefused) {
    const auto refused = [](GridWarp warp, const char* why) {
        const Status checked = check_grid_warp(warp);
        ASSERT_FALSE(checked) << why;
        EXPECT_THAT(checked.error().text(), HasSubstr(why));
    };
    GridWarp warp = bent();
    warp.columns = 0;
    refused(warp, "1 to 16 columns");
    warp.columns = 17;
    refused(warp, "1 to 16 columns");
    warp = bent();
    warp.points.pop_back();
    refused(warp, "has 12 points, not 11");
    warp = bent();
    warp.points[3].at.x = std::numeric_limits<double>::quiet_NaN();
    refused(warp, "point 4");
    warp = bent();
    warp.points[3].up = dvec2(0, -1e300);
    refused(warp, "point 4");
    warp = bent();
    warp.falloff_px = -1;
    refused(warp, "fall-off");
    warp = bent();
    warp.corners[2] = warp.corners[0];
    refused(warp, "convex");
    warp = bent();
    warp.keys = {{7, warp.points}, {7, warp.points}};
    refused(warp, "frame 7 has two keys");
    warp.keys = {{7, {}}};
    refused(warp, "on frame 7");
}

TEST(GridWarp, TextIsReadBack) {
    GridWarp warp = bent(kDeep);
    warp.falloff_px = 12.5;
    warp.points[2].left = dvec2(-10, 0.25);
    warp.points[2].down = dvec2(1, 20);
    set_key(warp, -3, warp.points);
    set_key(warp, 12, bent(kDeep).points);
    const auto back = parse_grid_warp(grid_warp_text(warp));
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(*back, warp);
    const auto rest = parse_grid_warp("2x1 corners 0,0 9,0 9,9 0,9");
    ASSERT_TRUE(rest);
    EXPECT_EQ(*rest, grid_over({dvec2(0, 0), dvec2(9, 0), dvec2(9, 9), dvec2(0, 9)}, 2, 1));
    for (const auto& [text, why] :
         {std::pair{"", "COLUMNSxROWS"},
          {"2x99 corners", "1x1 to 16x16"},
          {"2x2", "corners"},
          {"2x2 corners 1,1 2,2 3", "a corner such as"},
          {"2x2 corners 0,0 9,0 9,9 0,9 falloff much", "fall-off"},
          {"2x2 corners 0,0 9,0 9,9 0,9 points 1,2:x3,4", "a point such as"},
          {"1x1 corners 0,0 9,0 9,9 0,9 points 1,2 1,2 1,2 1,2 1,2", "more than 4 points"},
          {"1x1 corners 0,0 9,0 9,9 0,9 points 0,0 9,0 0,9 9,9 key x", "frame of a key"}}) {
        const auto wrong = parse_grid_warp(text);
        ASSERT_FALSE(wrong) << text;
        EXPECT_THAT(wrong.error().text(), HasSubstr(why)) << text;
    }
}

}  // namespace
}  // namespace weft
