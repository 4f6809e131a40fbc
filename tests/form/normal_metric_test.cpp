// From normals to a surface that lies flat, and the axes of a normal pass.
#include "engine/form/normal_metric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/form/depth_positions.h"
#include "engine/form/flatten.h"
#include "tests/form/surfaces.h"

namespace weft {
namespace {

constexpr ViewCamera kCamera{kFocal_px, {160, 120}};
constexpr std::array<double, 9> kSame{1, 0, 0, 0, 1, 0, 0, 0, 1};

Vec3 place(const Surface& surface, int x, int y) {
    const float* p = surface.place.pixel(x, y);
    return {p[0], p[1], p[2]};
}

Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// In view space, towards the camera; NaN at the rim of the surface.
ImageF3 normals_of(const Surface& surface) {
    ImageF3 out(kSize, std::numeric_limits<float>::quiet_NaN());
    for (int y = 1; y < kSize.height - 1; ++y) {
        for (int x = 1; x < kSize.width - 1; ++x) {
            Vec3 n = cross(place(surface, x + 1, y) - place(surface, x - 1, y),
                           place(surface, x, y + 1) - place(surface, x, y - 1));
            n /= -std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
            for (int c = 0; c < 3; ++c)
                out.pixel(x, y)[c] = n[c];
        }
    }
    return out;
}

LatticeField laid_by_normals(const Surface& surface) {
    MetricField field(kSize, kSpacing);
    add_normals(field, normals_of(surface), surface.matte, kCamera, still());
    EXPECT_TRUE(field.finish());
    return flat_from_reference(field).displacement;
}

TEST(NormalMetric, AFloorLiesInPerspective) {
    const Surface floor = seen(floor_below);
    const Distortion after = distortion(floor, laid_by_normals(floor));
    EXPECT_LT(after.stretch_median, 1.03);
    EXPECT_LT(after.stretch_p90, 1.08);
    EXPECT_LT(after.area_p90, 0.06);
    EXPECT_FALSE(after.flipped);
}

TEST(NormalMetric, AColumnIsUnrolled) {
    const Surface column = seen([](Vec3 r) { return sphere(r, {0, 0, 4}, 1, {1, 0, 1}); });
    const Distortion after = distortion(column, laid_by_normals(column));
    EXPECT_LT(after.stretch_median, 1.03);
    EXPECT_LT(after.stretch_p90, 1.08);
    EXPECT_LT(after.area_p90, 0.06);
    EXPECT_FALSE(after.flipped);
}

TEST(NormalMetric, ABallIsSpreadEvenly) {
    const Surface ball = seen([](Vec3 r) { return sphere(r, {0, 0, 4}, 1.2f, {1, 1, 1}); });
    const Distortion after = distortion(ball, laid_by_normals(ball));
    EXPECT_LT(after.stretch_median, 1.12);
    EXPECT_LT(after.stretch_p90, 1.30);
    EXPECT_LT(after.area_p90, 0.20);
    EXPECT_FALSE(after.flipped);
}

// Normals do not tell how far apart the parts of a surface are that a figure divides.
TEST(NormalMetric, BothSidesOfWhatStandsInFrontAreAsLarge) {
    Surface floor = seen(floor_below);
    for (int y = 0; y < kSize.height; ++y)
        std::fill_n(floor.matte.row(y) + 200, 40, 0);
    const Distortion after = distortion(floor, laid_by_normals(floor));
    EXPECT_LT(after.stretch_p90, 1.08);
    EXPECT_LT(after.area_p90, 0.06);
}

// A second frame's normals have another scale, which what both show decides.
// An index pass is hard, and normals are averaged: at its edge they are those of the background,
// too.
TEST(NormalMetric, TheEdgeOfAHardMatteSaysNothing) {
    Surface floor = seen(floor_below);
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 80; x < kSize.width; ++x)
            if (x / 16 % 2 != 0) floor.matte.at(x, y) = 0;
    const auto laid = [&](const ImageF3& normals) {
        MetricField field(kSize, kSpacing);
        add_normals(field, normals, floor.matte, kCamera, still());
        EXPECT_TRUE(field.finish());
        return flat_from_reference(field).displacement;
    };
    const ImageF3 clean = normals_of(floor);
    ImageF3 averaged = clean;
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 80; x < kSize.width; x += 16) {
            for (const int at : {x, x + 15}) {
                float* n = averaged.pixel(std::min(at, kSize.width - 1), y);
                n[0] = 0.5f * (n[0] + 1), n[1] *= 0.5f, n[2] *= 0.5f;
            }
        }
    }
    EXPECT_EQ(distortion(floor, laid(averaged)).stretch_median,
              distortion(floor, laid(clean)).stretch_median);
}

TEST(NormalMetric, FramesMeetInTheirSize) {
    constexpr int kShift = 120;
    const Surface first = seen(floor_below);
    const Surface second =
        seen([](Vec3 r) { return floor_below(r + Vec3(kShift / kFocal_px, 0, 0)); });
    ImageF3 normals = normals_of(seen(floor_below));  // a floor's normal is the same everywhere
    LatticeField motion(kSize, kSpacing);
    for (int j = 0; j < motion.nodes().height(); ++j)
        for (int i = 0; i < motion.nodes().width(); ++i)
            motion.set_node(i, j, {kShift, 0});
    MetricField field(kSize, {0, 0, kSize.width + kShift, kSize.height}, kSpacing);
    add_normals(field, normals, first.matte, kCamera, still());
    // The camera that sees it has its middle elsewhere.
    const ViewCamera shifted{kFocal_px, {160 - kShift, 120}};
    add_normals(field, normals, second.matte, shifted, motion, 0.01);
    ASSERT_TRUE(field.finish());
    const FormMap map = flat_from_reference(field);
    LatticeField out(kSize, kSpacing);
    for (int j = 0; j < out.nodes().height(); ++j)
        for (int i = 0; i < out.nodes().width(); ++i)
            out.set_node(i, j, map.at(out.node_position(i, j) + Vec2(kShift, 0)));
    Surface as_first = second;
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            as_first.place.pixel(x, y)[0] += kShift / kFocal_px * second.place.pixel(x, y)[2];
    const Distortion after = distortion(as_first, out);
    EXPECT_LT(after.stretch_p90, 1.08);
    EXPECT_LT(after.area_p90, 0.06);

    MetricField apart(kSize, kSpacing);
    add_normals(apart, normals, first.matte, kCamera, still());
    const double before = apart.log_area({160, 200}).value();
    for (int j = 0; j < motion.nodes().height(); ++j)
        for (int i = 0; i < motion.nodes().width(); ++i)
            motion.set_node(i, j, {0, -1000});
    add_normals(apart, normals, first.matte, kCamera, motion);
    EXPECT_EQ(apart.log_area({160, 200}).value(), before) << "frames that do not meet";
}

TEST(NormalMetric, ZeroOrUnknownNormalsSayNothing) {
    for (const float value :
         {0.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        const auto normals = view_normals(ImageF3(kSize, value), Matte(kSize, 255), kCamera, kSame);
        ASSERT_TRUE(normals);
        MetricField field(kSize, kSpacing);
        add_normals(field, *normals, Matte(kSize, 255), kCamera, still());
        EXPECT_FALSE(field.finish());
    }
}

// A pass of a ball in axes that `turn` gives from view space.
ImageF3 pass_of(const ImageF3& view, const std::function<Vec3(Vec3)>& turn) {
    ImageF3 out(kSize, 0.0f);
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const float* n = view.pixel(x, y);
            const Vec3 v = std::isfinite(n[0]) ? turn({n[0], n[1], n[2]}) : Vec3(0);
            for (int c = 0; c < 3; ++c)
                out.pixel(x, y)[c] = 3 * v[c];
        }
    }
    return out;
}

TEST(ViewNormals, TakeEitherDirectionOfTheAxisAndTheWorlds) {
    const Surface ball = seen([](Vec3 r) { return sphere(r, {0, 0, 4}, 1.2f, {1, 1, 1}); });
    const ImageF3 view = normals_of(ball);
    const auto expect_view = [&](const std::optional<ImageF3>& found, const char* what) {
        ASSERT_TRUE(found) << what;
        for (int y = 90; y < 150; y += 7)
            for (int x = 130; x < 190; x += 7)
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(found->pixel(x, y)[c], view.pixel(x, y)[c], 1e-5f) << what;
    };
    const auto back = pass_of(view, [](Vec3 n) { return Vec3(n.x, -n.y, -n.z); });
    expect_view(view_normals(back, ball.matte, kCamera, kSame), "z towards the camera");
    const auto into = pass_of(view, [](Vec3 n) { return Vec3(n.x, -n.y, n.z); });
    expect_view(view_normals(into, ball.matte, kCamera, kSame), "z into the scene");
    // A world whose x, y, z are the camera's z (towards it), x and y.
    const auto world = pass_of(view, [](Vec3 n) { return Vec3(-n.z, n.x, -n.y); });
    expect_view(view_normals(world, ball.matte, kCamera, {0, 1, 0, 0, 0, 1, 1, 0, 0}), "world");
    EXPECT_FALSE(view_normals(world, ball.matte, kCamera, kSame))
        << "half of a ball faces away in other axes";
}

TEST(DepthPositions, AreWhereTheRaysEnd) {
    const Surface floor = seen(floor_below);
    ImageF1 z(kSize, 1e10f), along(kSize, -1.0f);
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            if (!floor.matte.at(x, y)) continue;
            const Vec3 p = place(floor, x, y);
            z.at(x, y) = p.z;
            along.at(x, y) = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
        }
    }
    for (const auto& [depth, kind] : {std::pair{&z, DepthKind::kZ}, {&along, DepthKind::kRay}}) {
        const ImageF3 found = positions_from_depth(*depth, kind, kCamera);
        for (int y = 3; y < kSize.height; y += 20) {
            for (int x = 5; x < kSize.width; x += 20) {
                for (int c = 0; c < 3; ++c) {
                    if (!floor.matte.at(x, y))
                        EXPECT_TRUE(std::isnan(found.at(x, y, c)));
                    else
                        EXPECT_NEAR(found.at(x, y, c), floor.place.at(x, y, c), 1e-3f);
                }
            }
        }
    }
}

TEST(ViewCamera, HasTheFieldOfView) {
    EXPECT_NEAR(camera_with(90, {1000, 400}).focal_px, 500, 1e-9);
    EXPECT_EQ(camera_with(90, {1000, 400}).centre, Vec2(500, 200));
}

}  // namespace
}  // namespace weft
