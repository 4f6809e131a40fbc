// From a position pass to a surface that lies flat: planes, round things, and what cannot be laid.
#include "engine/form/flatten.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/form/position_metric.h"
#include "tests/form/surfaces.h"

namespace weft {
namespace {

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
