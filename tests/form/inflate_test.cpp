// Round surfaces from outlines.
#include "engine/form/inflate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/form/flatten.h"
#include "tests/form/surfaces.h"

namespace weft {
namespace {

Matte filled(const std::function<bool(float x, float y)>& inside) {
    Matte out(kSize);
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            out.at(x, y) =
                inside(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) ? 255 : 0;
    return out;
}

const ViewCamera kFar = camera_with(2, kSize);  // almost without perspective

MetricField inflated(const Matte& matte, const Matte& cut, double roundness = 1) {
    MetricField field(kSize, kSpacing);
    EXPECT_TRUE(add_inflated(field, matte, cut, matte, kFar, roundness));
    EXPECT_TRUE(field.finish());
    return field;
}

// The cosine at which the cell at a place is seen.
double facing_at(const MetricField& field, Vec2 place) {
    const int margin = LatticeField::kMargin;
    return facing(field.at(static_cast<int>(place.x) / kSpacing + margin,
                           static_cast<int>(place.y) / kSpacing + margin));
}

TEST(Inflate, ADiscBecomesABall) {
    const Matte disc = filled([](float x, float y) { return std::hypot(x - 160, y - 120) < 90; });
    const MetricField field = inflated(disc, Matte(kSize));
    for (const float off : {4.0f, 28.0f, 44.0f, 60.0f, 76.0f})
        EXPECT_NEAR(facing_at(field, {160 + off, 120}), std::sqrt(1 - off * off / 8100), 0.06)
            << off;
}

TEST(Inflate, AStripThatIsCutAtItsEndsBecomesATube) {
    const Matte strip =
        filled([](float x, float y) { return std::abs(x - 160) < 60 && std::abs(y - 120) < 80; });
    Matte cut(kSize);
    for (int x = 0; x < kSize.width; ++x)
        for (const int y : {39, 40, 41, 198, 199, 200})
            cut.at(x, y) = 255;
    const MetricField field = inflated(strip, cut);
    for (const float y : {52.0f, 120.0f, 188.0f})
        for (const float off : {4.0f, 20.0f, 36.0f, 52.0f})
            EXPECT_NEAR(facing_at(field, {160 + off, y}), std::sqrt(1 - off * off / 3600), 0.06)
                << off << " at " << y;
}

TEST(Inflate, ThePicturesBordersCut) {
    const Matte half = filled([](float x, float y) { return std::hypot(x, y - 120) < 90; });
    EXPECT_GT(facing_at(inflated(half, Matte(kSize)), {4, 120}), 0.97);
}

TEST(Inflate, RoundnessFlattens) {
    const Matte disc = filled([](float x, float y) { return std::hypot(x - 160, y - 120) < 90; });
    const double round = facing_at(inflated(disc, Matte(kSize)), {220, 120});
    const double flatter = facing_at(inflated(disc, Matte(kSize), 0.4), {220, 120});
    EXPECT_LT(round, 0.8);
    EXPECT_GT(flatter, 0.9);
}

TEST(Inflate, NothingThatTurnsAwayIsNoSurface) {
    MetricField field(kSize, kSpacing);
    const Matte all(kSize, 255), none(kSize),
        dot = filled([](float x, float y) { return std::hypot(x - 160, y - 120) < 2; });
    EXPECT_FALSE(add_inflated(field, all, none, all, kFar, 1)) << "cut all around";
    EXPECT_FALSE(add_inflated(field, none, none, none, kFar, 1));
    EXPECT_FALSE(add_inflated(field, dot, none, dot, kFar, 1));
}

// Laid on the true ball with less stretch than the flat picture, and never turned over, on outlines
// that are anything but a disc.
TEST(Inflate, IsLaidWithoutATear) {
    const Surface ball = seen([](Vec3 r) { return sphere(r, {0, 0, 4}, 1.1f, {1, 1, 1}); });
    MetricField field(kSize, kSpacing);
    ASSERT_TRUE(
        add_inflated(field, ball.matte, Matte(kSize), ball.matte, {kFocal_px, {160, 120}}, 1));
    ASSERT_TRUE(field.finish());
    const Distortion laid = distortion(ball, flat_from_reference(field).displacement);
    const Distortion flat = distortion(ball, still());
    EXPECT_FALSE(laid.flipped);
    EXPECT_LT(std::log(laid.stretch_median), 0.7 * std::log(flat.stretch_median));
    EXPECT_LT(laid.stretch_p90, flat.stretch_p90);
    EXPECT_LT(laid.area_p90, flat.area_p90);
    const Matte star = filled([](float x, float y) {
        const float r = std::hypot(x - 160, y - 120), a = std::atan2(y - 120, x - 160);
        return r < 70 + 30 * std::cos(5 * a) && !(std::abs(x - 150) < 2 && y < 110);
    });
    const LatticeField map = flat_from_reference(inflated(star, Matte(kSize))).displacement;
    for (int j = 0; j + 1 < map.nodes().height(); ++j) {
        for (int i = 0; i + 1 < map.nodes().width(); ++i) {
            const Vec2 x = map.node(i + 1, j) - map.node(i, j) + Vec2(kSpacing, 0);
            const Vec2 y = map.node(i, j + 1) - map.node(i, j) + Vec2(0, kSpacing);
            EXPECT_GT(x.x * y.y - x.y * y.x, 0) << i << ',' << j;
        }
    }
}

}  // namespace
}  // namespace weft
