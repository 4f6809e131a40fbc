// A plane is laid by one homography, as far as its horizon.
#include "engine/form/flat_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/form/form_level.h"
#include "engine/form/rigid_surface.h"
#include "tests/form/surfaces.h"

namespace weft {
namespace {

// A street that runs away from below the camera, turned to the side by some degrees; its horizon
// lies at about a quarter of the picture.
constexpr float kHorizon_px = 60;
const SeenPlane kStreet{{0.06, 0.98, 0.2}, {kFocal_px, {160, 120}}};

// Its places in the picture from `top` px below the horizon on, as a matte shows them.
MetricField seen_street(float top) {
    MetricField field(kSize, kSpacing);
    for (int y = 2; y < kSize.height; y += 4) {
        for (int x = 2; x < kSize.width; x += 4) {
            const Vec2 place(static_cast<float>(x), static_cast<float>(y));
            if (place.y > kHorizon_px + top) field.add(place, {1, 0, 1}, 1);
        }
    }
    EXPECT_TRUE(field.finish());
    return field;
}

double least_seen(float top) {
    double least = 1;
    for (const float x : {0.0f, 320.0f})
        least = std::min(least, kStreet.nearness({x, kHorizon_px + top}));
    return 0.6 * least;
}

Vec2 flat(const FormMap& form, Vec2 place) {
    return place + form.at(place);
}

double true_distance(Vec2 a, Vec2 b) {
    const glm::dvec3 d =
        kStreet.camera.ray(a) / kStreet.nearness(a) - kStreet.camera.ray(b) / kStreet.nearness(b);
    return std::sqrt(glm::dot(d, d));
}

TEST(FlatPlane, KeepsDistancesFromTheFeetToTheHorizon) {
    const FormMap form = flat_plane(kStreet, least_seen(15), seen_street(15));
    const auto scale = [&](Vec2 a, Vec2 b) {
        return glm::length(flat(form, a) - flat(form, b)) / true_distance(a, b);
    };
    const double near = scale({100, 230}, {200, 230});
    EXPECT_NEAR(scale({150, 239}, {150, 200}) / near, 1, 0.002);
    EXPECT_NEAR(scale({20, 120}, {300, 125}) / near, 1, 0.002);
    EXPECT_NEAR(scale({60, 90}, {250, 230}) / near, 1, 0.01);
    EXPECT_NEAR(scale({20, 78}, {300, 78}) / near, 1, 0.04) << "just below the horizon";
}

TEST(FlatPlane, StraightLinesStayStraight) {
    const FormMap form = flat_plane(kStreet, least_seen(15), seen_street(15));
    const auto bend_px = [&](Vec2 from, Vec2 to) {
        const Vec2 a = flat(form, from), b = flat(form, to);
        const Vec2 along = (b - a) / glm::length(b - a);
        float most = 0;
        for (int tenth = 1; tenth < 10; ++tenth) {
            const Vec2 d = flat(form, from + 0.1f * static_cast<float>(tenth) * (to - from)) - a;
            most = std::max(most, std::abs(along.x * d.y - along.y * d.x));
        }
        return most;
    };
    EXPECT_LT(bend_px({0, 235}, {319, 235}), 0.05f);
    EXPECT_LT(bend_px({0, 110}, {319, 200}), 0.1f);
    EXPECT_LT(bend_px({140, 90}, {20, 239}), 0.3f);
}

TEST(FlatPlane, NothingFoldsOverBeyondTheHorizon) {
    const FormMap form = flat_plane(kStreet, least_seen(15), seen_street(15));
    for (const float x : {10.0f, 160.0f, 310.0f}) {
        for (int row = 0; row < 236; row += 4) {
            const auto y = static_cast<float>(row);
            const Vec2 d = flat(form, {x, y + 4}) - flat(form, {x, y});
            EXPECT_TRUE(std::isfinite(d.x) && std::isfinite(d.y));
            EXPECT_GT(d.y, 0) << "at " << x << ", " << y;
        }
    }
}

TEST(FlatPlane, IsTheMoreUprightTheLessItIsBelieved) {
    RigidSurface street;
    street.middle = {160, 120};
    street.long_side = 320;
    street.tangent = 320 / static_cast<double>(kFocal_px);
    street.centre = {160, 180};
    street.radius = 60;
    street.slope_y = 0.8;
    const auto foreshortening = [&](double share) {
        const SeenPlane plane = street.plane(share);
        EXPECT_NEAR(plane.nearness(street.centre), 1, 1e-9);
        return plane.nearness({160, 230}) / plane.nearness({160, 130});
    };
    EXPECT_NEAR(foreshortening(1), street.nearness({160, 230}) / street.nearness({160, 130}), 1e-6);
    EXPECT_NEAR(foreshortening(0), 1, 1e-9);
    EXPECT_LT(foreshortening(0.7), foreshortening(1));
}

TEST(FlatPlane, IsTurnedSoThatRowsOrColumnsRunAlongItsLines) {
    FormMap form = flat_plane(kStreet, least_seen(15), seen_street(15));
    const Vec2 centre(160, 180);
    for (const Vec2 direction : {Vec2(1, 0.2f), Vec2(0.3f, 1), Vec2(-1, 0.4f)}) {
        const Vec2 before = flat(form, centre);
        turn_square(form, centre, direction);
        const Vec2 d = flat(form, centre + direction) - flat(form, centre - direction);
        const float off = std::min(std::abs(d.x), std::abs(d.y)) / glm::length(d);
        EXPECT_LT(off, 1e-3f);
        EXPECT_NEAR(glm::length(flat(form, centre) - before), 0, 0.1) << "turned about its centre";
    }
}

}  // namespace
}  // namespace weft
