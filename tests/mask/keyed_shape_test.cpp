#include "engine/mask/keyed_shape.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

RotoShape square_at(float left, float top, float side = 20) {
    RotoShape shape;
    for (const Vec2 at : {Vec2{left, top}, Vec2{left + side, top}, Vec2{left + side, top + side},
                          Vec2{left, top + side}})
        shape.points.push_back({at, {0, 0}, {0, 0}, 2});
    return shape;
}

constexpr Quad<double> kBox{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}};

// Turned by a right angle about (50, 50), twice as large, and moved by (30, 10).
Quad<double> turned() {
    Quad<double> out;
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec2 d = kBox[k] - glm::dvec2(50, 50);
        out[k] = glm::dvec2(80, 60) + 2.0 * glm::dvec2(-d.y, d.x);
    }
    return out;
}

void expect_near(Vec2 a, Vec2 b) {
    EXPECT_NEAR(a.x, b.x, 1e-3);
    EXPECT_NEAR(a.y, b.y, 1e-3);
}

// A surface that turns on an anamorphic plate: seen unsqueezed, the shape turns and is not sheared.
TEST(KeyedShape, ASimilarityIsOneOfTheUnsqueezedPicture) {
    const PixelAspect aspect(2);
    Quad<double> before = kBox, after = turned();
    for (Quad<double>* corners : {&before, &after})
        for (glm::dvec2& corner : *corners)
            corner = aspect.squeezed(corner);
    const CornerTrack track{{1, before}, {2, after}};
    RotoShape drawn = square_at(40, 40), seen = drawn;
    for (RotoPoint& point : drawn.points)
        point.at = aspect.squeezed(point.at);
    KeyedShape shape{{{1, drawn}}, ShapeFollow::kSimilarity, "t"};
    const RotoShape squeezed = shape_on(shape, track, 2, aspect);
    shape.keys = {{1, seen}};
    const RotoShape wanted = shape_on(shape, {{1, kBox}, {2, turned()}}, 2);
    for (std::size_t k = 0; k < 4; ++k) {
        expect_near(aspect.unsqueezed(squeezed.points[k].at), wanted.points[k].at);
        EXPECT_NEAR(squeezed.points[k].feather_px, wanted.points[k].feather_px, 1e-3);
    }
}

TEST(KeyedShape, TakesOfTheTrackWhatItFollows) {
    const CornerTrack track{{1, kBox}, {2, turned()}};
    KeyedShape shape{{{1, square_at(40, 40)}}, ShapeFollow::kNone, "t"};
    const auto corner = [&](ShapeFollow follow) {
        shape.follow = follow;
        return shape_on(shape, track, 2).points[0];
    };
    expect_near(corner(ShapeFollow::kNone).at, {40, 40});
    expect_near(corner(ShapeFollow::kPosition).at, {70, 50});
    // (40, 40) is (-10, -10) from the middle: (10, -10) when turned, and twice that.
    expect_near(corner(ShapeFollow::kSimilarity).at, {100, 40});
    expect_near(corner(ShapeFollow::kPlanar).at, {100, 40});
    EXPECT_NEAR(corner(ShapeFollow::kPlanar).feather_px, 4, 1e-3);
    EXPECT_EQ(shape_on(shape, track, 1), square_at(40, 40)) << "its own frame";
    expect_near(shape_on(shape, track, 99).points[0].at, {100, 40});
}

TEST(KeyedShape, FollowsAPlaneInPerspective) {
    const Quad<double> floor{{{40, 20}, {60, 20}, {100, 100}, {0, 100}}};
    const CornerTrack track{{1, kBox}, {2, floor}};
    const KeyedShape shape{{{1, square_at(0, 0, 100)}}, ShapeFollow::kPlanar, "t"};
    const RotoShape there = shape_on(shape, track, 2);
    for (std::size_t k = 0; k < 4; ++k)
        expect_near(there.points[k].at, Vec2(floor[k]));
    EXPECT_LT(there.points[0].feather_px, there.points[3].feather_px) << "farther away";
}

TEST(KeyedShape, HandlesGoWithTheMotion) {
    RotoShape shape = square_at(40, 40);
    shape.points[0].out = {5, 0};
    const RotoShape there =
        moved(shape, track_motion({{1, kBox}, {2, turned()}}, ShapeFollow::kSimilarity, 1, 2));
    expect_near(there.points[0].out, {0, 10});
    EXPECT_EQ(there.points[0].in, Vec2(0, 0)) << "a corner stays one";
}

// A second key is an offset to the track: half of it shows half way.
TEST(KeyedShape, KeysAreOffsetsRelativeToTheTrack) {
    CornerTrack track;
    for (int f = 1; f <= 9; ++f) {
        track[f] = kBox;
        for (glm::dvec2& corner : track[f])
            corner.x += 10 * (f - 1);
    }
    KeyedShape shape{{{1, square_at(10, 10)}, {9, square_at(94, 10)}}, ShapeFollow::kPosition, "t"};
    // The track alone leads to 90 on frame 9.
    expect_near(shape_on(shape, track, 5).points[0].at, {52, 10});
    expect_near(shape_on(shape, track, 9).points[0].at, {94, 10});
    shape.follow = ShapeFollow::kNone;
    expect_near(shape_on(shape, {}, 5).points[0].at, {52, 10});
}

TEST(KeyedShape, BeyondTheHorizonItStays) {
    // A plane that vanishes near y = 0 of its own.
    const glm::dmat3 motion{1, 0, 0, 0, 1, 0.02, 0, 0, -0.5};
    EXPECT_EQ(moved(square_at(10, 10), motion), square_at(10, 10));
    EXPECT_NE(moved(square_at(10, 60), motion), square_at(10, 60));
}

TEST(KeyedShape, TheTrackStandsStillBeyondItsFrames) {
    const CornerTrack track{{5, kBox}, {6, turned()}};
    EXPECT_EQ(track_motion(track, ShapeFollow::kPlanar, 1, 5), glm::dmat3(1));
    EXPECT_EQ(track_motion(track, ShapeFollow::kPlanar, 6, 60), glm::dmat3(1));
    EXPECT_EQ(track_motion({}, ShapeFollow::kPlanar, 1, 5), glm::dmat3(1));
}

}  // namespace
}  // namespace weft
