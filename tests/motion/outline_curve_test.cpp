#include "engine/motion/outline_curve.h"

#include <gtest/gtest.h>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kOutlineFrame{200, 160};

Matte rectangle(Vec2 middle, Vec2 half) {
    return draw(kOutlineFrame, [&](Vec2 p) {
        const Vec2 q = glm::abs(p - middle);
        return q.x < half.x && q.y < half.y ? 1.0f : 0.0f;
    });
}

TEST(OutlineCurve, IsSampledEvenlyAroundTheLargestPiece) {
    Matte two = rectangle({100, 80}, {50, 30});
    for (int y = 5; y < 15; ++y)
        std::fill(two.row(y) + 5, two.row(y) + 15, std::uint8_t{255});
    const OutlineCurve curve = outline_curve(two);
    ASSERT_FALSE(curve.p.empty());
    EXPECT_NEAR(curve.step_px * static_cast<float>(curve.p.size()), 320, 8);
    for (std::size_t k = 0; k < curve.p.size(); ++k) {
        EXPECT_EQ(curve.cut[k], 0);
        const Vec2 q = glm::abs(curve.p[k] - Vec2(100, 80));
        EXPECT_LT(std::max(q.x - 50, q.y - 30), 0.1f);
        EXPECT_GT(std::max(q.x - 50, q.y - 30), -2.5f);
        const Vec2 next = curve.p[(k + 1) % curve.p.size()];
        EXPECT_NEAR(distance(curve.p[k], next), curve.step_px, 0.5f);
    }
}

TEST(OutlineCurve, KnowsWhereTheFrameCutsIt) {
    const OutlineCurve curve = outline_curve(rectangle({0, 80}, {60, 30}));
    ASSERT_FALSE(curve.p.empty());
    const auto cut = std::count(curve.cut.begin(), curve.cut.end(), 1);
    EXPECT_NEAR(static_cast<double>(cut) / static_cast<double>(curve.p.size()), 60.0 / 240, 0.04);
    EXPECT_TRUE(match_outlines(curve, curve, moved_by(kOutlineFrame, {0, 0})).empty());
}

TEST(OutlineCurve, PairsCornersWithCornersWhereverTheShapeWent) {
    const OutlineCurve prev = outline_curve(rectangle({80, 70}, {50, 30}));
    const OutlineCurve cur = outline_curve(rectangle({115, 88}, {50, 30}));
    // Half of the way is a rough guess.
    const auto pairs = match_outlines(prev, cur, moved_by(kOutlineFrame, {-17, -9}));
    ASSERT_GT(pairs.size(), 150U);
    for (const OutlinePair& pair : pairs)
        EXPECT_LT(distance(pair.prev - pair.cur, Vec2(-35, -18)), 3.5f);
}

TEST(OutlineCurve, SlipIsNoneForTheTrueMotionAndMuchAlongAnEdge) {
    const OutlineCurve prev = outline_curve(rectangle({80, 70}, {50, 30}));
    const OutlineCurve cur = outline_curve(rectangle({115, 88}, {50, 30}));
    EXPECT_LT(outline_slip(prev, cur, moved_by(kOutlineFrame, {-35, -18})), 0.01);
    EXPECT_GT(outline_slip(prev, cur, moved_by(kOutlineFrame, {-15, -18})), 0.05);
    EXPECT_EQ(
        outline_slip(prev, outline_curve(Matte(kOutlineFrame)), moved_by(kOutlineFrame, {0, 0})),
        1);
}

}  // namespace
}  // namespace weft
