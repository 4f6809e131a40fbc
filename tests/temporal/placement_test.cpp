#include "engine/temporal/placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <limits>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

TextureMapping::Inverse inverse_of(const PlanePlacement& p) {
    const auto map = texture_mapping(p);
    EXPECT_TRUE(map.has_value()) << (map ? "" : map.error().text());
    return map.value_or(TextureMapping()).inverse();
}

Vec2 on_plate(const PlanePlacement& p, Vec2 texel) {
    return inverse_of(p).pixel(texel);
}

TEST(Placement, DefaultIsTheIdentity) {
    EXPECT_LT(distance(on_plate({}, {12, 34}), {12, 34}), 1e-5f);
}

TEST(Placement, TurnsCounterClockwiseOnTheScreen) {
    PlanePlacement p;
    p.rotate_deg = 90;
    // The plane's x axis points up the screen, where y is smaller; its y axis to the right.
    EXPECT_LT(distance(on_plate(p, {10, 0}), {0, -10}), 1e-4f);
    EXPECT_LT(distance(on_plate(p, {0, 10}), {10, 0}), 1e-4f);
    p.rotate_deg = 30;
    EXPECT_LT(distance(on_plate(p, {10, 0}), {8.660254f, -5}), 1e-4f);
}

TEST(Placement, ScaleIsPlatePixelsATexelAboutTheOffset) {
    PlanePlacement p;
    p.scale = 2.5f;
    p.offset_px = {100, 40};
    EXPECT_LT(distance(on_plate(p, {0, 0}), {100, 40}), 1e-3f);
    EXPECT_LT(distance(on_plate(p, {10, 4}), {125, 50}), 1e-3f);
    p.rotate_deg = 180;
    EXPECT_LT(distance(on_plate(p, {0, 0}), {100, 40}), 1e-3f);
    EXPECT_LT(distance(on_plate(p, {10, 4}), {75, 30}), 1e-3f);
}

// Of an anamorphic plate scale, rotation and squares are those of the picture unsqueezed.
TEST(Placement, ActsOnTheUnsqueezedPicture) {
    PlanePlacement p;
    p.aspect = PixelAspect(2);
    p.offset_px = {100, 40};
    EXPECT_LT(distance(on_plate(p, {0, 0}), {100, 40}), 1e-3f);
    EXPECT_LT(distance(on_plate(p, {16, 0}), {108, 40}), 1e-3f);
    EXPECT_LT(distance(on_plate(p, {0, 16}), {100, 56}), 1e-3f);
    p.scale = 3;
    for (const float degrees : {0.0f, 30.0f, 45.0f, 90.0f, 200.0f}) {
        p.rotate_deg = degrees;
        const Vec2 origin = p.aspect.unsqueezed(on_plate(p, {0, 0}));
        const Vec2 u = p.aspect.unsqueezed(on_plate(p, {10, 0})) - origin;
        const Vec2 v = p.aspect.unsqueezed(on_plate(p, {0, 10})) - origin;
        EXPECT_NEAR(std::hypot(u.x, u.y), 30, 1e-2f) << degrees;
        EXPECT_NEAR(std::hypot(v.x, v.y), 30, 1e-2f) << degrees;
        EXPECT_NEAR(u.x * v.x + u.y * v.y, 0, 1e-1f) << degrees << ": no shear";
        const float turned = std::atan2(-u.y, u.x) * 180 / 3.14159265f;
        EXPECT_NEAR(std::remainder(turned - degrees, 360.0f), 0, 1e-2f);
    }
}

// Every way to ask the mapping gives the same answer.
TEST(Placement, AnAnamorphicMappingAgreesWithItself) {
    PlanePlacement p;
    p.aspect = PixelAspect(2);
    p.scale = 1.7f;
    p.rotate_deg = 30;
    p.offset_px = {20, 30};
    const TextureMapping map = *texture_mapping(p);
    const Vec2 at(61, 47), step(0.5f, 0.25f);
    EXPECT_LT(distance(map.inverse().pixel(map.texel(at)), at), 1e-3f);
    const auto here = map.linear_at(at);
    EXPECT_LT(distance(here.texel, map.texel(at)), 1e-4f);
    EXPECT_LT(distance(here.step(step), map.texel(at + step) - map.texel(at)), 1e-3f);
    EXPECT_LT(distance(map.on_smaller_frame(2).texel(at / 2.0f), map.texel(at)), 1e-3f);
}

// A square of the picture unsqueezed, given by its corners on the plate, holds squares.
TEST(Placement, CornersOfAnAnamorphicPlateHoldSquares) {
    PlanePlacement p;
    p.aspect = PixelAspect(2);
    p.corners = {Vec2(10, 20), Vec2(60, 20), Vec2(60, 120), Vec2(10, 120)};
    const TextureMapping map = *texture_mapping(p);
    EXPECT_LT(distance(map.texel({60, 120}), {100, 100}), 0.1f);
    EXPECT_LT(distance(map.texel({35, 20}), {50, 0}), 0.1f);
    p.rotate_deg = 45;
    const TextureMapping turned = *texture_mapping(p);
    const Vec2 right = turned.texel({40, 60}) - turned.texel({35, 60});
    const Vec2 down = turned.texel({35, 70}) - turned.texel({35, 60});
    EXPECT_NEAR(std::hypot(right.x, right.y), std::hypot(down.x, down.y), 0.01f);
    EXPECT_NEAR(right.x * down.x + right.y * down.y, 0, 0.1f);
}

const std::array<Vec2, 4> kFloor{Vec2(120, 60), Vec2(220, 70), Vec2(300, 180), Vec2(40, 170)};

TEST(Placement, CornersBoundARectangleOfThePlane) {
    PlanePlacement p;
    p.corners = kFloor;
    const auto map = texture_mapping(p);
    ASSERT_TRUE(map);
    const Vec2 a = map->texel(kFloor[0]), b = map->texel(kFloor[1]);
    const Vec2 c = map->texel(kFloor[2]), d = map->texel(kFloor[3]);
    EXPECT_LT(distance(a, {0, 0}), 0.01f);
    EXPECT_GT(b.x, 10);
    EXPECT_NEAR(b.y, 0, 0.01f);
    EXPECT_GT(d.y, 10);
    EXPECT_NEAR(d.x, 0, 0.01f);
    EXPECT_LT(distance(c, {b.x, d.y}), 0.05f);
}

TEST(Placement, APictureIsFittedIntoTheCorners) {
    PlanePlacement p;
    p.corners = kFloor;
    p.picture_texels = Size{300, 120};
    const TextureMapping map = *texture_mapping(p);
    const std::array<Vec2, 4> own{Vec2(0, 0), Vec2(300, 0), Vec2(300, 120), Vec2(0, 120)};
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_LT(distance(map.texel(kFloor[k]), own[k]), 0.01f);
    p.scale = 2;  // twice as large: a quarter of it shows
    EXPECT_LT(distance(texture_mapping(p)->texel(kFloor[2]), Vec2(150, 60)), 0.01f);
}

TEST(Placement, ScaleHoldsAtTheTopLeftCorner) {
    for (const float scale : {0.5f, 1.0f, 3.0f}) {
        PlanePlacement p;
        p.corners = kFloor;
        p.scale = scale;
        const TextureMapping::Inverse plate = inverse_of(p);
        const Vec2 origin = plate.pixel({0, 0});
        EXPECT_LT(distance(origin, kFloor[0]), 0.01f);
        const float step = 0.5f / scale;  // half a pixel
        EXPECT_NEAR(distance(plate.pixel({step, 0}), origin), 0.5f, 0.01f);
        EXPECT_NEAR(distance(plate.pixel({0, step}), origin), 0.5f, 0.01f);
    }
}

TEST(Placement, AParallelogramHasNoPerspective) {
    PlanePlacement p;
    p.corners = {Vec2(10, 20), Vec2(110, 20), Vec2(140, 70), Vec2(40, 70)};
    EXPECT_LT(distance(on_plate(p, {50, 0}), {60, 20}), 0.05f);
    const float left = std::hypot(30.0f, 50.0f);
    EXPECT_LT(distance(on_plate(p, {100, left}), {140, 70}), 0.05f);
    EXPECT_LT(distance(on_plate(p, {50, left / 2}), {75, 45}), 0.05f);
}

TEST(Placement, RotationAndOffsetActInsideThePlane) {
    PlanePlacement still, turned;
    still.corners = turned.corners = kFloor;
    turned.rotate_deg = 90;
    turned.offset_px = {20, 10};
    turned.scale = still.scale = 2;
    // A texel of the turned plane lies where the still plane has offset/scale + R · texel.
    const Vec2 expected = on_plate(still, Vec2(10, 5) + Vec2(0, -7));
    EXPECT_LT(distance(on_plate(turned, {7, 0}), expected), 0.02f);
}

TEST(Placement, RefusesAScaleThatIsNone) {
    for (const float scale : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity()}) {
        PlanePlacement p;
        p.scale = scale;
        const auto map = texture_mapping(p);
        ASSERT_FALSE(map) << scale;
        EXPECT_EQ(map.error().code, ErrorCode::kUsage);
        EXPECT_NE(map.error().text().find("scale"), std::string::npos);
    }
}

TEST(Placement, RefusesCornersThatAreNoQuadrilateral) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::array<std::array<Vec2, 4>, 4> wrong{{
        {Vec2(0, 0), Vec2(100, 100), Vec2(100, 0), Vec2(0, 100)},  // crossed
        {Vec2(0, 0), Vec2(50, 0), Vec2(100, 0), Vec2(0, 100)},     // three in a line
        {Vec2(0, 0), Vec2(100, 0), Vec2(20, 20), Vec2(0, 100)},    // dented
        {Vec2(0, 0), Vec2(100, 0), Vec2(nan, 100), Vec2(0, 100)},
    }};
    for (const auto& corners : wrong) {
        PlanePlacement p;
        p.corners = corners;
        const auto map = texture_mapping(p);
        ASSERT_FALSE(map);
        EXPECT_EQ(map.error().code, ErrorCode::kUsage);
        EXPECT_NE(map.error().text().find("corners"), std::string::npos);
    }
}

TEST(TextureCoords, AreThePlacementAtTheReferencePosition) {
    PlanePlacement p;
    p.scale = 2;
    p.rotate_deg = 20;
    p.offset_px = {5, 6};
    const TextureMapping map = *texture_mapping(p);
    LatticeField moved({64, 48}, 8);
    for (int j = 0; j < moved.nodes().height(); ++j) {
        for (int i = 0; i < moved.nodes().width(); ++i)
            moved.set_node(i, j, {3.5f, -1.25f});
    }
    const TextureCoords coords = texture_coords(moved, map, {10, 12, 30, 40});
    EXPECT_EQ(coords.size(), (Size{20, 28}));
    EXPECT_EQ(coords.origin, Vec2i(10, 12));
    for (const Vec2i at : {Vec2i(0, 0), Vec2i(19, 27), Vec2i(7, 3)}) {
        const float* uv = coords.uv.pixel(at.x, at.y);
        const Vec2 expected = map.texel(Vec2(coords.origin + at) + 0.5f + Vec2(3.5f, -1.25f));
        EXPECT_LT(distance({uv[0], uv[1]}, expected), 1e-3f);
    }
}

}  // namespace
}  // namespace weft
