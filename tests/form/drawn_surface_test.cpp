#include "engine/form/drawn_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/form/flatten.h"
#include "engine/form/form_level.h"
#include "tests/form/surfaces.h"

namespace weft {
namespace {

using ::testing::HasSubstr;

constexpr double kFov_deg = 56.14;  // of kFocal_px

// Where a place of the floor lies on the picture.
glm::dvec2 on_picture(glm::dvec3 p) {
    return {160 + 300 * p.x / p.z, 120 + 300 * p.y / p.z};
}

// A point of floor_below()'s plane: 0.35 z + 0.94 y = 1.5.
glm::dvec3 on_floor(double x, double z) {
    return {x, (1.5 - 0.35 * z) / 0.94, z};
}

std::vector<double> numbers(const std::vector<glm::dvec2>& places) {
    std::vector<double> out;
    for (const glm::dvec2& p : places)
        out.insert(out.end(), {p.x, p.y});
    return out;
}

// The floor's tilt against the picture: its normal is (0, 0.94, 0.35).
constexpr double kFloorTilt_deg = 69.6;

FormGuide floor_quad(double near, double far) {
    return {FormGuideKind::kPlane,
            numbers({on_picture(on_floor(-0.7, far)), on_picture(on_floor(0.5, far)),
                     on_picture(on_floor(0.5, near)), on_picture(on_floor(-0.7, near))})};
}

// The same, turned by 37° on the floor: both pairs of sides run to a vanishing point.
FormGuide turned_quad() {
    const auto corner = [](double a, double b) {
        const double x = 0.8 * a - 0.6 * b, deeper = 0.6 * a + 0.8 * b;
        return on_picture(on_floor(x, 2.3 + 0.94 * deeper));
    };
    return {FormGuideKind::kPlane,
            numbers({corner(-0.5, 0.6), corner(0.5, 0.6), corner(0.5, -0.6), corner(-0.5, -0.6)})};
}

Distortion laid_distortion(const DrawnSurface& drawn, const Surface& truth) {
    MetricField field(kSize, kSpacing);
    for (int y = 0; y < kSize.height; y += 2) {
        for (int x = 0; x < kSize.width; x += 2) {
            if (truth.matte.at(x, y) != 255) continue;
            const Vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const auto metric = drawn.metric(at);
            if (metric) field.add(at, *metric, facing(*metric) * facing(*metric));
        }
    }
    EXPECT_TRUE(field.finish());
    return distortion(truth, flat_from_reference(field).displacement);
}

// Half the width of a matte on a row, and its middle.
std::pair<double, double> width_on(const Matte& matte, int y) {
    int first = kSize.width, last = -1;
    for (int x = 0; x < kSize.width; ++x) {
        if (matte.at(x, y) != 255) continue;
        first = std::min(first, x);
        last = std::max(last, x);
    }
    return {0.5 * (last + 1 - first), 0.5 * (last + 1 + first)};
}

// As drawn by hand: an axis down the middle, radii from the outline.
FormGuide round_over(FormGuideKind kind, const Matte& matte, int top, int bottom) {
    const auto [ra, ax] = width_on(matte, top);
    const auto [rb, bx] = width_on(matte, bottom);
    return {kind, {ax, top + 0.5, bx, bottom + 0.5, ra, rb}};
}

Surface cylinder(float leaning) {
    const float c = std::cos(leaning), s = std::sin(leaning);
    const auto turned = [&](Vec3 v) { return Vec3(v.x, c * v.y - s * v.z, s * v.y + c * v.z); };
    return seen([&](Vec3 r) { return sphere(turned(r), turned({0, 0, 4}), 1, {1, 0, 1}); });
}

TEST(DrawnSurface, AQuadTellsThePlaneAndTheFieldOfView) {
    const auto plane = drawn_surface(turned_quad(), {kSize, {}});
    ASSERT_TRUE(plane);
    EXPECT_TRUE(plane->is_plane());
    EXPECT_NEAR(plane->tilt_deg, kFloorTilt_deg, 2.5);
    EXPECT_NEAR(plane->fov_deg, kFov_deg, 4);
    EXPECT_LT(plane->tilt_error_deg, 5);
    const Distortion d = laid_distortion(*plane, seen(floor_below));
    EXPECT_LT(d.stretch_median, 1.06);
    EXPECT_LT(d.stretch_p90, 1.20);
    EXPECT_FALSE(d.flipped);
}

// One vanishing point says nothing of the focal length, and the error says so.
TEST(DrawnSurface, TheErrorCoversWhatAQuadDoesNotTell) {
    const auto plane = drawn_surface(floor_quad(1.7, 3.6), {kSize, {}});
    ASSERT_TRUE(plane);
    EXPECT_GT(plane->tilt_error_deg, 4);
    EXPECT_LT(std::abs(plane->tilt_deg - kFloorTilt_deg), plane->tilt_error_deg);
    EXPECT_LT(laid_distortion(*plane, seen(floor_below)).stretch_p90, 1.20);
}

TEST(DrawnSurface, AKnownFieldOfViewGivesTheTiltItself) {
    const auto plane = drawn_surface(floor_quad(1.7, 3.6), {kSize, kFov_deg});
    ASSERT_TRUE(plane);
    EXPECT_NEAR(plane->tilt_deg, kFloorTilt_deg, 1);
    EXPECT_NEAR(plane->fov_deg, kFov_deg, 0.01);
}

TEST(DrawnSurface, ASquareThatFacesTheCameraIsFlat) {
    const FormGuide square{FormGuideKind::kPlane, {110, 70, 210, 70, 210, 170, 110, 170}};
    const auto plane = drawn_surface(square, {kSize, {}});
    ASSERT_TRUE(plane);
    EXPECT_LT(plane->tilt_deg, 1);
}

TEST(DrawnSurface, TwoGroupsOfStrokesTellThePlane) {
    const auto line = [](double x0, double z0, double x1, double z1) {
        return numbers({on_picture(on_floor(x0, z0)), on_picture(on_floor(x1, z1))});
    };
    const auto both = [](std::vector<double> a, const std::vector<double>& b) {
        a.insert(a.end(), b.begin(), b.end());
        return a;
    };
    const std::vector<FormGuide> strokes{
        {FormGuideKind::kParallel, both(line(-0.6, 1.6, 0.2, 3.2), line(0.2, 1.6, 0.8, 2.8))},
        {FormGuideKind::kParallel, both(line(0.6, 1.7, -0.6, 2.3), line(0.8, 2.4, -0.6, 3.1))}};
    const auto plane = drawn_plane(strokes, {kSize, {}});
    ASSERT_TRUE(plane);
    EXPECT_NEAR(plane->tilt_deg, kFloorTilt_deg, 5);
    EXPECT_NEAR(plane->fov_deg, kFov_deg, 8);
}

TEST(DrawnSurface, TwoStrokesThatRunAwayFromBelowAreAFloor) {
    auto away = numbers({on_picture(on_floor(-0.6, 1.6)), on_picture(on_floor(-0.6, 3.4)),
                         on_picture(on_floor(0.6, 1.6)), on_picture(on_floor(0.6, 3.4))});
    const auto plane = drawn_plane({{FormGuideKind::kParallel, away}}, {kSize, kFov_deg});
    ASSERT_TRUE(plane);
    EXPECT_NEAR(plane->tilt_deg, kFloorTilt_deg, 2);
    EXPECT_LT(laid_distortion(*plane, seen(floor_below)).stretch_p90, 1.08);
}

TEST(DrawnSurface, StrokesThatCrossAreRefused) {
    const auto crossing =
        drawn_plane({{FormGuideKind::kParallel, {10, 10, 90, 90, 10, 90, 90, 10}}}, {kSize, {}});
    ASSERT_FALSE(crossing);
    EXPECT_THAT(crossing.error().sentence(), HasSubstr("cross each other"));
    EXPECT_FALSE(drawn_plane({{FormGuideKind::kParallel, {10, 10, 90, 90}}}, {kSize, {}}));
}

TEST(DrawnSurface, ACylinderUnrolls) {
    for (const float leaning : {0.0f, 0.35f, -0.35f}) {
        const Surface truth = cylinder(leaning);
        const FormGuide guide = round_over(FormGuideKind::kCylinder, truth.matte, 20, 219);
        const auto drawn = drawn_surface(guide, {kSize, {}});
        ASSERT_TRUE(drawn);
        const Distortion d = laid_distortion(*drawn, truth);
        EXPECT_LT(d.stretch_median, 1.06) << leaning;
        EXPECT_LT(d.stretch_p90, 1.20) << leaning;
        EXPECT_LT(d.area_p90, 0.12) << leaning;
        EXPECT_FALSE(d.flipped);
    }
}

TEST(DrawnSurface, ATiltReplacesWhatTheOutlinesTell) {
    const Surface truth = cylinder(0.35f);
    FormGuide guide = round_over(FormGuideKind::kCylinder, truth.matte, 20, 219);
    const auto found = drawn_surface(guide, {kSize, kFov_deg});
    ASSERT_TRUE(found);
    const auto axis = std::get<DrawnCylinder>(found->body).axis;
    EXPECT_NEAR(std::abs(axis.z), std::sin(0.35), 0.03);
    for (const double tilt : {-30.0, 30.0}) {
        guide.numbers.resize(6);
        guide.numbers.push_back(tilt);
        const auto tilted = drawn_surface(guide, {kSize, kFov_deg});
        ASSERT_TRUE(tilted);
        EXPECT_NEAR(std::get<DrawnCylinder>(tilted->body).axis.z, tilt > 0 ? 0.5 : -0.5, 0.03);
    }
}

TEST(DrawnSurface, AConeUnrolls) {
    const Surface truth = seen([](Vec3 r) {
        // Apex at (0, -2.2, 4), half an angle of 20° around the direction down.
        const float k = 0.8830f;
        const Vec3 v(0, -2.2f, 4);
        const float rr = glm::dot(r, r), rv = glm::dot(r, v), vv = glm::dot(v, v);
        const float a = r.y * r.y - k * rr, b = r.y * v.y - k * rv, c = v.y * v.y - k * vv;
        const float under = b * b - a * c;
        if (under < 0) return 0.0f;
        const float t = std::min((b - std::sqrt(under)) / a, (b + std::sqrt(under)) / a);
        return t * r.y > v.y ? t : 0.0f;
    });
    const auto drawn =
        drawn_surface(round_over(FormGuideKind::kCone, truth.matte, 20, 219), {kSize, kFov_deg});
    ASSERT_TRUE(drawn);
    EXPECT_TRUE(std::holds_alternative<DrawnCone>(drawn->body));
    const Distortion d = laid_distortion(*drawn, truth);
    EXPECT_LT(d.stretch_median, 1.06);
    EXPECT_LT(d.stretch_p90, 1.20);
    EXPECT_FALSE(d.flipped);
}

TEST(DrawnSurface, ABallIsSpreadEvenly) {
    const Surface truth = seen([](Vec3 r) { return sphere(r, {0, 0, 4}, 1, {1, 1, 1}); });
    const auto [radius, middle] = width_on(truth.matte, 120);
    const auto drawn = drawn_surface({FormGuideKind::kBall, {middle, 120, radius}}, {kSize, {}});
    ASSERT_TRUE(drawn);
    const Distortion d = laid_distortion(*drawn, truth);
    EXPECT_LT(d.stretch_median, 1.14);
    EXPECT_LT(d.stretch_p90, 1.35);
    EXPECT_FALSE(d.flipped);
}

TEST(DrawnSurface, ACylinderThatPointsAtTheCameraIsRefused) {
    const auto drawn =
        drawn_surface({FormGuideKind::kCylinder, {150, 110, 165, 125, 80, 10}}, {kSize, {}});
    ASSERT_FALSE(drawn);
    EXPECT_THAT(drawn.error().sentence(), HasSubstr("point at the camera"));
}

TEST(DrawnSurface, NothingIsSeenBesideARoundThing) {
    const auto ball = drawn_surface({FormGuideKind::kBall, {160, 120, 40}}, {kSize, {}});
    ASSERT_TRUE(ball);
    EXPECT_TRUE(ball->metric({160, 120}));
    EXPECT_FALSE(ball->metric({230, 120}));
}

TEST(FormGuide, TextReadsBack) {
    const std::string text = "plane:10,10.5,90,12,95,80,5,78; level:10,20,80,22";
    const auto guides = parse_form_guides(text);
    ASSERT_TRUE(guides);
    EXPECT_EQ(form_guides_text(*guides), text);
    for (const FormGuide& guide : *guides)
        EXPECT_TRUE(check_form_guide(guide));
}

TEST(FormGuide, WhatCollapsesIsRefused) {
    for (const char* wrong :
         {"plane:10,10,90,90,90,10,10,90", "plane:1,2,3", "cylinder:5,5,5,5,10,10",
          "cylinder:5,5,50,5,0,10", "cone:5,5,50,5,0,0", "ball:5,5,0", "level:4,4,4,4",
          "parallel:1,2,3,4,5", "cone:5,5,50,5,10,4,85", "ball:1e9,5,5"}) {
        const auto guides = parse_form_guides(wrong);
        ASSERT_TRUE(guides) << wrong;
        EXPECT_FALSE(check_form_guide(guides->front())) << wrong;
    }
    for (const char* wrong : {"plane", "box:1,2", "ball:1,x,3", "ball:nan,1,2"})
        EXPECT_FALSE(parse_form_guides(wrong)) << wrong;
}

TEST(FormLevel, RowsRunAlongTheStroke) {
    FormMap form{{}, LatticeField(kSize, kSpacing), {}};
    // 3-4-5: drawn from right to left all the same.
    turn_level(form, {{FormGuideKind::kLevel, {120, 130, 40, 70}}}, {80, 100});
    const auto flat = [&](Vec2 p) { return p + form.at(p); };
    const Vec2 d = flat({120, 130}) - flat({40, 70});
    EXPECT_NEAR(d.x, 100, 1e-3);
    EXPECT_NEAR(d.y, 0, 1e-3);
    EXPECT_NEAR(flat({80, 100}).x, 80, 1e-3);
}

}  // namespace
}  // namespace weft
