#include "engine/motion/plane_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "engine/core/rng.h"

namespace weft {
namespace {

// A wall seen from the side that moves.
Vec2 moved_wall(Vec2 p) {
    const float w = 1 + 0.0004f * p.x - 0.0002f * p.y;
    return Vec2(4 + 1.02f * p.x - 0.03f * p.y, -7 + 0.02f * p.x + 0.98f * p.y) / w;
}

Vec2 scatter(Rng& rng, float reach_px) {
    const auto once = [&] { return reach_px * (2 * static_cast<float>(rng.uniform()) - 1); };
    return {once(), once()};
}

// Pairs on a grid of n × n places, 9 px apart.
std::vector<PlacePair> wall_pairs(int n) {
    std::vector<PlacePair> pairs;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const Vec2 p(20 + 9 * i, 30 + 9 * j);
            pairs.push_back({p, moved_wall(p)});
        }
    }
    return pairs;
}

float farthest_off(const glm::dmat3& plane, const std::vector<PlacePair>& places) {
    float most = 0;
    for (const PlacePair& pair : places)
        most = std::max(most, distance(mapped(plane, pair.from), moved_wall(pair.from)));
    return most;
}

TEST(PlaneFit, FindsAHomographyUnderOutliers) {
    const std::vector<PlacePair> all = wall_pairs(10);
    std::vector<PlacePair> pairs = all;
    Rng rng(1);
    for (std::size_t k = 0; k < pairs.size(); k += 4)
        pairs[k].to += scatter(rng, 60);
    EXPECT_LT(farthest_off(fit_plane(pairs), all), 0.1f);
    // Plain least squares follow them.
    const auto plain = fit_homography(pairs);
    ASSERT_TRUE(plain);
    EXPECT_GT(farthest_off(*plain, all), 2);
}

// Two fifths of the places, on one side, move as one thing of their own.
TEST(PlaneFit, FromTheMedianItIsNotDraggedByWhatMovesOtherwise) {
    const std::vector<PlacePair> all = wall_pairs(10);
    std::vector<PlacePair> pairs = all;
    for (PlacePair& pair : pairs)
        if (pair.from.x > 70) pair.to += Vec2(30, -20);
    const glm::dmat3 dragged = fit_plane(pairs, {.rounds = 6});
    const glm::dmat3 plane = fit_plane(pairs, {.rounds = 6, .from_median = true});
    EXPECT_LT(farthest_off(plane, {all.begin(), all.begin() + 5}), 0.5f);
    EXPECT_GT(farthest_off(dragged, {all.begin(), all.begin() + 5}), 2);
}

TEST(PlaneFit, PlacesOnALineKeepTheirScaleAcrossIt) {
    std::vector<PlacePair> pairs;
    pairs.reserve(40);
    for (int k = 0; k < 40; ++k)
        pairs.push_back({Vec2(10 + k, 50), Vec2(10 + k, 50) + Vec2(5, 3)});
    EXPECT_LT(distance(mapped(fit_plane(pairs), {30, 60}), {35, 63}), 0.2f);
    EXPECT_FALSE(fit_homography(pairs));
}

TEST(PlaneFit, FewPlacesMoveTogetherAndNoneStayPut) {
    EXPECT_LT(distance(mapped(fit_plane({{{1, 2}, {4, 6}}}), {10, 10}), {13, 14}), 1e-4f);
    EXPECT_EQ(mapped(fit_plane({}), {10, 10}), Vec2(10, 10));
    EXPECT_EQ(moved_by(fit_plane({}), {10, 10}), Vec2(0, 0));
    // By most of them if it begins with the median: a stray one of three counts for nothing.
    const std::vector<PlacePair> three{{{1, 2}, {4, 6}}, {{5, 2}, {8, 6}}, {{5, 5}, {90, 70}}};
    const glm::dmat3 moved = fit_plane(three, {.fewest = 32, .from_median = true});
    EXPECT_LT(distance(moved_by(moved, {10, 10}), {3, 4}), 1e-4f);
}

TEST(PlaneFit, FourCornersAreMetExactly) {
    const std::vector<PlacePair> all = wall_pairs(10);
    const std::vector<PlacePair> corners{all[0], all[9], all[90], all[99]};
    const auto exact = fit_homography(corners);
    ASSERT_TRUE(exact);
    EXPECT_LT(farthest_off(*exact, all), 2e-3f);
    EXPECT_FALSE(fit_homography({all[0], all[9], all[90]}));
    EXPECT_FALSE(fit_homography({all[0], all[9], all[90], all[90]}));
}

}  // namespace
}  // namespace weft
