// A rectangle on a plane that was found.
#include "engine/form/plane_corners.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/form/flatten.h"
#include "engine/form/position_metric.h"
#include "tests/form/surfaces.h"

namespace weft {
namespace {

FormMap laid_form(const Surface& surface, FormFinding::Source source, bool plane) {
    MetricField field(kSize, kSpacing);
    add_positions(field, surface.place, surface.matte, still(), 1);
    EXPECT_TRUE(field.finish());
    FormMap out = flat_from_reference(field);
    out.finding.source = source;
    out.finding.plane = plane;
    return out;
}

Vec3 floor_seen_at(Vec2 at) {
    const Vec3 r((at.x - 160) / kFocal_px, (at.y - 120) / kFocal_px, 1);
    return floor_below(r) * r;
}

TEST(PlaneCorners, AreARectangleOnTheFloorInsideOfTheBox) {
    const Surface floor = seen(floor_below);
    const auto corners =
        plane_corners(laid_form(floor, FormFinding::Source::kMotion, true), floor.matte);
    ASSERT_TRUE(corners);
    for (const Vec2 corner : *corners) {
        EXPECT_GE(corner.x, 0);
        EXPECT_LE(corner.x, kSize.width);
        EXPECT_LE(corner.y, kSize.height);
        EXPECT_GT(corner.y, 40) << "below the horizon";
    }
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 a = floor_seen_at((*corners)[(k + 1) % 4]) - floor_seen_at((*corners)[k]);
        const Vec3 b = floor_seen_at((*corners)[(k + 3) % 4]) - floor_seen_at((*corners)[k]);
        const auto dot = [](Vec3 u, Vec3 v) { return u.x * v.x + u.y * v.y + u.z * v.z; };
        EXPECT_NEAR(dot(a, b) / std::sqrt(dot(a, a) * dot(b, b)), 0, 0.05) << "a right angle";
    }
    // It narrows into the distance.
    EXPECT_LT((*corners)[1].x - (*corners)[0].x, 0.9f * ((*corners)[2].x - (*corners)[3].x));
}

TEST(PlaneCorners, APassSaysItselfWhetherItShowsAPlane) {
    const Surface floor = seen(floor_below);
    EXPECT_TRUE(plane_corners(laid_form(floor, FormFinding::Source::kPass, false), floor.matte));
    const Surface ball = seen([](Vec3 r) { return sphere(r, {0, 0, 4}, 1.1f, {1, 1, 1}); });
    EXPECT_FALSE(plane_corners(laid_form(ball, FormFinding::Source::kPass, false), ball.matte));
}

TEST(PlaneCorners, WhatIsNoPlaneHasNone) {
    const Surface floor = seen(floor_below);
    EXPECT_FALSE(plane_corners(laid_form(floor, FormFinding::Source::kNone, true), floor.matte));
    EXPECT_FALSE(plane_corners(laid_form(floor, FormFinding::Source::kShape, false), floor.matte));
    EXPECT_FALSE(plane_corners(laid_form(floor, FormFinding::Source::kMotion, true), Matte(kSize)));
}

}  // namespace
}  // namespace weft
