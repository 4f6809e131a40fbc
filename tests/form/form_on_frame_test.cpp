// The surface in front of the camera from its metric, and as another frame shows it.
#include "engine/form/form_on_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/form/form_relief.h"
#include "engine/form/position_metric.h"
#include "tests/form/surfaces.h"

namespace weft {
namespace {

const double kFullFov_deg = 2 * std::atan(160.0 / kFocal_px) * 180 / 3.14159265358979;

float ball(Vec3 r) {
    return sphere(r, {0.1f, 0, 4}, 1, {1, 1, 1});
}

MetricField measured(const Surface& surface) {
    MetricField field(kSize, kSpacing);
    add_positions(field, surface.place, surface.matte, still(), 1);
    EXPECT_TRUE(field.finish());
    return field;
}

FormMap form_of(const Surface& surface) {
    const MetricField field = measured(surface);
    FormMap out{{}, still()};
    out.finding.source = FormFinding::Source::kPass;
    add_relief(out, field, kFullFov_deg, kSize, false);
    return out;
}

// Where the relief is known, its depth against the true one: the largest error, relative.
double depth_off(const Surface& surface) {
    const FormMap form = form_of(surface);
    double most = 0;
    for (int y = 12; y < kSize.height - 12; y += 7) {
        for (int x = 12; x < kSize.width - 12; x += 7) {
            bool inside = true;
            for (const auto& [u, v] : {std::pair{-12, 0}, {12, 0}, {0, -12}, {0, 12}})
                inside = inside && surface.matte.at(x + u, y + v) == 255;
            if (!inside) continue;
            const Vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const Vec2 found = form.relief.at(at);
            EXPECT_GT(found.y, 0.9f);
            most =
                std::max<double>(most, std::abs(std::exp(found.x) / surface.place.at(x, y, 2) - 1));
        }
    }
    return most;
}

TEST(FormRelief, DepthFollowsFromTheMetricInThePassesUnit) {
    EXPECT_LT(depth_off(seen(floor_below)), 0.02);
    EXPECT_LT(depth_off(seen(ball)), 0.02);
}

TEST(FormRelief, TheFieldOfViewIsFoundWhereTheSurfaceTells) {
    EXPECT_NEAR(fov_of_metric(measured(seen(floor_below)), kSize), kFullFov_deg, 3);
    EXPECT_NEAR(fov_of_metric(measured(seen(ball)), kSize), kFullFov_deg, 6);
}

// A camera that has moved by `shift` and turned by `turn` about the upright axis.
struct Moved {
    Vec3 shift;
    float turn;

    [[nodiscard]] Vec3 into(Vec3 v) const {
        const float c = std::cos(turn), s = std::sin(turn);
        return {c * v.x - s * v.z, v.y, s * v.x + c * v.z};
    }
    [[nodiscard]] Vec3 ray_on_reference(int x, int y) const {
        const Vec3 r = ray(x, y);
        const float c = std::cos(turn), s = std::sin(turn);
        return {c * r.x + s * r.z, r.y, -s * r.x + c * r.z};
    }
};

TEST(FormOnFrame, TheReferenceFrameShowsTheNormalsOfABall) {
    const Surface surface = seen(ball);
    const ShownForm shown =
        form_on_frame(form_of(surface), still(), surface.matte, rect_of(kSize), 1);
    int compared = 0;
    for (int y = 10; y < kSize.height - 10; y += 5) {
        for (int x = 10; x < kSize.width - 10; x += 5) {
            if (surface.matte.at(x, y) == 0) {
                EXPECT_EQ(shown.confidence.at(x, y), 0);
                continue;
            }
            const float* p = surface.place.pixel(x, y);
            const Vec3 n(p[0] - 0.1f, p[1], p[2] - 4);
            // The lattice is coarse against the rim: two of its cells from there.
            if (std::hypot(n.x, n.y) > 0.75f) continue;
            const float* found = shown.normal.pixel(x, y);
            const float cosine = n.x * found[0] - n.y * found[1] - n.z * found[2];
            EXPECT_GT(cosine, std::cos(0.1f)) << x << ',' << y;
            EXPECT_NEAR(shown.depth.at(x, y), p[2], 0.03f * p[2]);
            EXPECT_NEAR(shown.confidence.at(x, y), 1, 0.01f);
            ++compared;
        }
    }
    EXPECT_GT(compared, 200);
}

// The floor has one normal; another camera sees it turned.
TEST(FormOnFrame, AnotherFrameShowsItTurned) {
    const Surface floor = seen(floor_below);
    const FormMap form = form_of(floor);
    const Moved camera{{0.3f, 0.05f, 0.1f}, 0.2f};
    LatticeField ref_from_cur(kSize, kSpacing);
    Matte matte(kSize);
    const auto back = [&](Vec2 at) {
        const Vec3 r = camera.ray_on_reference(0, 0) +
                       at.x / kFocal_px * Vec3(std::cos(0.2f), 0, -std::sin(0.2f)) +
                       Vec3(0, at.y / kFocal_px, 0) -
                       0.5f / kFocal_px * Vec3(std::cos(0.2f), 1, -std::sin(0.2f));
        const float down = 0.35f * r.z + 0.94f * r.y;
        const float t = (1.5f - 0.35f * camera.shift.z - 0.94f * camera.shift.y) / down;
        const Vec3 place = camera.shift + t * r;
        return Vec2(160 + kFocal_px * place.x / place.z, 120 + kFocal_px * place.y / place.z);
    };
    for (int j = 0; j < ref_from_cur.nodes().height(); ++j)
        for (int i = 0; i < ref_from_cur.nodes().width(); ++i)
            if (const Vec2 at = ref_from_cur.node_position(i, j); at.y > 60)
                ref_from_cur.set_node(i, j, back(at) - at);
    for (int y = 100; y < 220; ++y)
        for (int x = 60; x < 260; ++x)
            matte.at(x, y) = 255;
    const ShownForm shown = form_on_frame(form, ref_from_cur, matte, rect_of(kSize), 1);
    const float norm = std::sqrt(0.35f * 0.35f + 0.94f * 0.94f);
    const Vec3 n = camera.into(Vec3(0, -0.94f, -0.35f) / norm);
    for (const auto& [x, y] : {std::pair{100, 120}, {160, 160}, {200, 180}}) {
        const float* found = shown.normal.pixel(x, y);
        EXPECT_GT(n.x * found[0] - n.y * found[1] - n.z * found[2], std::cos(0.05f)) << x;
        EXPECT_GT(shown.confidence.at(x, y), 0.9f);
    }
}

TEST(FormOnFrame, WhatIsNotRigidIsLessSure) {
    const Surface surface = seen(ball);
    const FormMap form = form_of(surface);
    LatticeField waves = still();
    for (int j = 0; j < waves.nodes().height(); ++j)
        for (int i = 0; i < waves.nodes().width(); ++i)
            waves.set_node(i, j, {6 * std::sin(static_cast<float>(i * j)), 0});
    const ShownForm shown = form_on_frame(form, waves, surface.matte, rect_of(kSize), 1);
    EXPECT_LT(shown.confidence.at(165, 120), 0.5f);
}

TEST(FormOnFrame, AFlatSurfaceShowsNothing) {
    const Surface surface = seen(ball);
    FormMap form = form_of(surface);
    form.finding.source = FormFinding::Source::kNone;
    const ShownForm shown = form_on_frame(form, still(), surface.matte, rect_of(kSize), 1);
    EXPECT_EQ(shown.confidence.at(160, 120), 0);
    EXPECT_EQ(shown.normal.at(160, 120, 2), 0);
}

}  // namespace
}  // namespace weft
