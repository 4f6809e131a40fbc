#include "engine/mask/shape_matte.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

RotoShape square(float left, float feather_px = 0) {
    RotoShape shape;
    for (const Vec2 at : {Vec2{left, 10}, Vec2{left + 20, 10}, Vec2{left + 20, 30}, Vec2{left, 30}})
        shape.points.push_back({at, {0, 0}, {0, 0}, feather_px});
    return shape;
}

TEST(RotoShape, FillsItsInsideAndFallsOffOverTheFeather) {
    const Matte hard = matte_of_shape(square(10), {60, 40});
    EXPECT_EQ(hard.at(20, 20), 255);
    EXPECT_EQ(hard.at(35, 20), 0);
    const Matte soft = matte_of_shape(square(10, 8), {60, 40});
    EXPECT_EQ(soft.at(20, 20), 255);
    EXPECT_GT(soft.at(32, 20), 0);
    EXPECT_LT(soft.at(35, 20), soft.at(32, 20));
    EXPECT_EQ(soft.at(42, 20), 0);
    RotoShape line = square(10);
    line.points.resize(2);
    const Matte thin = matte_of_shape(line, {60, 40});
    EXPECT_EQ(thin.at(20, 12), 0) << "two points have no inside";
}

// The feather of an anamorphic plate reaches half as many pixels to the side as up.
TEST(RotoShape, ItsFeatherIsEvenOnTheUnsqueezedPicture) {
    const Matte soft = matte_of_shape(square(10, 8), {60, 50}, PixelAspect(2));
    EXPECT_EQ(soft.at(20, 20), 255);
    EXPECT_GT(soft.at(31, 20), 0);
    EXPECT_EQ(soft.at(35, 20), 0);
    EXPECT_GT(soft.at(20, 34), 0);
    EXPECT_EQ(soft.at(20, 39), 0);
    for (int d = 0; d < 3; ++d) {
        const int side = soft.at(30 + d, 20),
                  below = (soft.at(20, 30 + 2 * d) + soft.at(20, 31 + 2 * d)) / 2;
        EXPECT_NEAR(side, below, 20) << d;
    }
    EXPECT_EQ(matte_of_shape(square(10), {60, 50}, PixelAspect(2)),
              matte_of_shape(square(10), {60, 50}));
}

TEST(RotoShape, InterpolatesPointByPoint) {
    EXPECT_EQ(between(square(0), square(10), 0), square(0));
    EXPECT_EQ(between(square(0), square(10), 0.5f).points[1].at, Vec2(25, 10));
    RotoShape triangle = square(10);
    triangle.points.pop_back();
    EXPECT_EQ(between(square(0), triangle, 0.5f), square(0));
}

TEST(RotoShape, SmoothedCornersHaveHandles) {
    const RotoShape shape = square(3.25f, 1.5f);
    const RotoShape round = smoothed(shape);
    ASSERT_EQ(round.points.size(), shape.points.size());
    for (std::size_t k = 0; k < shape.points.size(); ++k) {
        EXPECT_EQ(round.points[k].at, shape.points[k].at);
        EXPECT_NE(round.points[k], shape.points[k]);
    }
}

TEST(RotoShape, TheOutlineRunsThroughThePoints) {
    const auto outline = outline_of(square(10), 4);
    for (const RotoPoint& point : square(10).points)
        EXPECT_NE(std::find(outline.begin(), outline.end(), point.at), outline.end());
}

TEST(RotoShape, FarPointsDoNotSpillIntoTheFrame) {
    RotoShape far = square(10);
    far.points[1].at = {1e20f, 10};
    far.points[2].at = {1e20f, 30};
    const Matte matte = matte_of_shape(far, {60, 40});
    EXPECT_EQ(matte.at(50, 20), 255);
    EXPECT_EQ(matte.at(50, 5), 0);
    EXPECT_EQ(matte.at(50, 35), 0);
}

}  // namespace
}  // namespace weft
