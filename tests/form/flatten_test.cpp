// From a position pass to a surface that lies flat: planes, round things, and what cannot be laid.
#include "engine/form/flatten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "engine/form/position_metric.h"

namespace weft {
namespace {

constexpr Size kSize{320, 240};
constexpr float kFocal_px = 300;
constexpr int kSpacing = 8;

// The ray of a pixel from the origin; z is the depth.
Vec3 ray(int x, int y) {
    return {(static_cast<float>(x) + 0.5f - 160) / kFocal_px,
            (static_cast<float>(y) + 0.5f - 120) / kFocal_px, 1};
}

struct Surface {
    ImageF3 place{kSize};
    Matte matte{kSize};
};

// `hit`: the distance along the ray, or nothing.
Surface seen(const std::function<float(Vec3)>& hit) {
    Surface out;
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const Vec3 r = ray(x, y);
            const float t = hit(r);
            const bool found = t > 0;
            for (int c = 0; c < 3; ++c)
                out.place.pixel(x, y)[c] =
                    found ? t * r[c] : std::numeric_limits<float>::quiet_NaN();
            out.matte.at(x, y) = found ? 255 : 0;
        }
    }
    return out;
}

float sphere(Vec3 ray, Vec3 centre, float radius, Vec3 use) {
    const Vec3 r = ray * use, c = centre * use;
    const float a = r.x * r.x + r.y * r.y + r.z * r.z, b = r.x * c.x + r.y * c.y + r.z * c.z;
    const float d = b * b - a * (c.x * c.x + c.y * c.y + c.z * c.z - radius * radius);
    return d < 0 ? 0.0f : (b - std::sqrt(d)) / a;
}

struct Distortion {
    double stretch_median = 0, stretch_p90 = 0, area_p90 = 0;  // area in ln
    bool flipped = false;
};

// Of the surface's own steps, 4 px inside of its matte and where it is not seen edge-on.
Distortion distortion(const Surface& surface, const LatticeField& flat) {
    std::vector<double> stretch, area;
    Distortion out;
    for (int y = 6; y < kSize.height - 6; ++y) {
        for (int x = 6; x < kSize.width - 6; ++x) {
            bool inside = true;
            for (const auto& [u, v] : {std::pair{-4, 0}, {4, 0}, {0, -4}, {0, 4}, {0, 0}})
                inside = inside && surface.matte.at(x + u, y + v) == 255;
            if (!inside) continue;
            const auto place = [&](int u, int v) {
                const float* p = surface.place.pixel(x + u, y + v);
                return Vec3(p[0], p[1], p[2]);
            };
            const Vec3 px = 0.5f * (place(1, 0) - place(-1, 0));
            const Vec3 py = 0.5f * (place(0, 1) - place(0, -1));
            const auto dot = [](Vec3 a, Vec3 b) {
                return static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y +
                       static_cast<double>(a.z) * b.z;
            };
            const Metric g{dot(px, px), dot(px, py), dot(py, py)};
            if (facing(g) < 0.15) continue;
            const Vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const Vec2 ux = flat.at(at + Vec2(0.5f, 0)) - flat.at(at - Vec2(0.5f, 0)) + Vec2(1, 0);
            const Vec2 uy = flat.at(at + Vec2(0, 0.5f)) - flat.at(at - Vec2(0, 0.5f)) + Vec2(0, 1);
            const double xx = ux.x * ux.x + ux.y * ux.y, xy = ux.x * uy.x + ux.y * uy.y;
            const double yy = uy.x * uy.x + uy.y * uy.y;
            const double half = (g.yy * xx - 2 * g.xy * xy + g.xx * yy) / (2 * g.determinant());
            const double determinant = (xx * yy - xy * xy) / g.determinant();
            const double root = std::sqrt(std::max(0.0, half * half - determinant));
            stretch.push_back(std::sqrt((half + root) / (half - root)));
            area.push_back(0.5 * std::log(determinant));
            out.flipped = out.flipped || ux.x * uy.y - ux.y * uy.x <= 0;
        }
    }
    const auto at = [](std::vector<double> v, double share) {
        std::sort(v.begin(), v.end());
        return v[static_cast<std::size_t>(share * static_cast<double>(v.size() - 1))];
    };
    out.stretch_median = at(stretch, 0.5);
    out.stretch_p90 = at(stretch, 0.9);
    const double middle = at(area, 0.5);
    for (double& a : area)
        a = std::abs(a - middle);
    out.area_p90 = at(area, 0.9);
    return out;
}

float floor_below(Vec3 r) {
    const float down = 0.35f * r.z + 0.94f * r.y;
    return down > 0.2f ? 1.5f / down : 0.0f;
}

LatticeField still() {
    return {kSize, kSpacing};
}

LatticeField laid(const Surface& surface) {
    MetricField field(kSize, kSpacing);
    add_positions(field, surface.place, surface.matte, still());
    EXPECT_TRUE(field.finish());
    return flat_from_reference(field).displacement;
}

TEST(Flatten, AFloorLiesInPerspective) {
    // 20° below the camera, from 1.5 away to the top of the picture.
    const Surface floor = seen(floor_below);
    const LatticeField none(kSize, kSpacing);
    const Distortion before = distortion(floor, none), after = distortion(floor, laid(floor));
    EXPECT_GT(before.stretch_median, 1.5);
    EXPECT_LT(after.stretch_median, 1.03);
    EXPECT_LT(after.stretch_p90, 1.08);
    EXPECT_LT(after.area_p90, 0.06);
    EXPECT_FALSE(after.flipped);
}

TEST(Flatten, AColumnIsUnrolled) {
    const Surface column = seen([](Vec3 r) { return sphere(r, {0, 0, 4}, 1, {1, 0, 1}); });
    const Distortion before = distortion(column, LatticeField(kSize, kSpacing));
    const Distortion after = distortion(column, laid(column));
    EXPECT_GT(before.stretch_p90, 1.5);
    EXPECT_LT(after.stretch_median, 1.03);
    EXPECT_LT(after.stretch_p90, 1.08);
    EXPECT_LT(after.area_p90, 0.06);
    EXPECT_FALSE(after.flipped);
}

TEST(Flatten, ABallIsSpreadEvenly) {
    const Surface ball = seen([](Vec3 r) { return sphere(r, {0, 0, 4}, 1.2f, {1, 1, 1}); });
    const Distortion before = distortion(ball, LatticeField(kSize, kSpacing));
    const Distortion after = distortion(ball, laid(ball));
    EXPECT_GT(before.stretch_p90, 1.8);
    EXPECT_LT(after.stretch_median, 1.12);
    EXPECT_LT(after.stretch_p90, 1.30);
    EXPECT_LT(after.area_p90, 0.20);
    EXPECT_FALSE(after.flipped);
}

TEST(Flatten, WhatFacesTheCameraStaysWhereItIs) {
    const LatticeField flat = laid(seen([](Vec3) { return 3.0f; }));
    for (int y = 0; y < kSize.height; y += 20)
        for (int x = 0; x < kSize.width; x += 20)
            for (int c = 0; c < 2; ++c)
                EXPECT_NEAR(flat.at({static_cast<float>(x), static_cast<float>(y)})[c], 0, 0.02f);
}

// A camera that shifts its picture by 120 px shows more of the floor on a second frame.
TEST(Flatten, WhatComesIntoViewIsLaidFromTheFrameThatShowsIt) {
    constexpr int kShift = 120;
    const Surface first = seen(floor_below);
    const Surface second =
        seen([](Vec3 r) { return floor_below(r + Vec3(kShift / kFocal_px, 0, 0)); });
    Surface shifted = second;  // its places, as the first camera measures them
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            shifted.place.pixel(x, y)[0] += kShift / kFocal_px * second.place.pixel(x, y)[2];
    LatticeField motion(kSize, kSpacing);
    for (int j = 0; j < motion.nodes().height(); ++j)
        for (int i = 0; i < motion.nodes().width(); ++i)
            motion.set_node(i, j, {kShift, 0});

    const Recti domain{0, 0, kSize.width + kShift, kSize.height};
    MetricField field(kSize, domain, kSpacing), alone(kSize, domain, kSpacing);
    for (MetricField* f : {&field, &alone})
        add_positions(*f, first.place, first.matte, still());
    add_positions(field, shifted.place, shifted.matte, motion, 0.05);
    ASSERT_TRUE(field.finish() && alone.finish());
    const FormMap both = flat_from_reference(field), one = flat_from_reference(alone);

    const auto seen_by_second = [&](const FormMap& map) {
        LatticeField out(kSize, kSpacing);
        for (int j = 0; j < out.nodes().height(); ++j)
            for (int i = 0; i < out.nodes().width(); ++i)
                out.set_node(i, j, map.at(out.node_position(i, j) + Vec2(kShift, 0)));
        return distortion(shifted, out);
    };
    const Distortion with = seen_by_second(both), without = seen_by_second(one);
    EXPECT_LT(with.stretch_p90, 1.08);
    EXPECT_LT(with.area_p90, 0.06);
    EXPECT_LT(std::log(with.stretch_p90), 0.5 * std::log(without.stretch_p90));
    EXPECT_FALSE(with.flipped);
    // The first frame's floor lies where it lay, as large and as upright.
    EXPECT_NEAR(distortion(first, both.displacement).stretch_p90, 1, 0.08);
}

// A metric is pulled back to the reference frame exactly.
TEST(PositionMetric, IsThatOfTheReferenceFrame) {
    // Places that the reference frame would see as P = (2 x, y, 0); a frame that is turned and
    // larger.
    LatticeField motion(kSize, kSpacing);
    const auto placed = [](Vec2 p) { return Vec2(0.5f * p.x + 0.2f * p.y + 60, 0.6f * p.y + 30); };
    for (int j = 0; j < motion.nodes().height(); ++j)
        for (int i = 0; i < motion.nodes().width(); ++i)
            motion.set_node(i, j, placed(motion.node_position(i, j)) - motion.node_position(i, j));
    ImageF3 place(kSize);
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const Vec2 ref = placed({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
            place.pixel(x, y)[0] = 2 * ref.x, place.pixel(x, y)[1] = ref.y;
        }
    }
    MetricField field(kSize, kSpacing);
    add_positions(field, place, Matte(kSize, 255), motion);
    ASSERT_TRUE(field.finish());
    // As an area of 1: diag (4, 1) / 2.
    const Metric& m = field.at(kSize.width / 2 / kSpacing, kSize.height / 2 / kSpacing);
    EXPECT_NEAR(m.xx, 2, 1e-3);
    EXPECT_NEAR(m.xy, 0, 1e-3);
    EXPECT_NEAR(m.yy, 0.5, 1e-3);
}

TEST(Flatten, ConstantOrUnknownPlacesSayNothing) {
    Surface none = seen([](Vec3) { return 0.0f; });
    MetricField field(kSize, kSpacing);
    add_positions(field, none.place, Matte(kSize, 255), still());
    EXPECT_FALSE(field.finish());
    MetricField constant(kSize, kSpacing);
    add_positions(constant, ImageF3(kSize, 2.0f), Matte(kSize, 255), still());
    EXPECT_FALSE(constant.finish());
}

}  // namespace
}  // namespace weft
