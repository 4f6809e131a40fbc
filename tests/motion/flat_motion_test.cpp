#include "engine/motion/flat_motion.h"

#include <gtest/gtest.h>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kLeaningFrame{160, 120};

// Leans and moves.
Vec2 moved(Vec2 p) {
    const float w = 1 + 0.0004f * p.x - 0.0003f * p.y;
    return Vec2(1.02f * p.x + 0.03f * p.y - 4, -0.02f * p.x + 0.99f * p.y + 3) / w;
}

TEST(FlatMotion, IsThePlaneOfMostOfTheMotion) {
    ImageF2 flow(kLeaningFrame);
    Matte weights(kLeaningFrame, 200);
    for (int y = 0; y < kLeaningFrame.height; ++y) {
        for (int x = 0; x < kLeaningFrame.width; ++x) {
            // A fifth of it found itself again 20 px further.
            const Vec2 p = centre_of(x, y), d = moved(p) - p + Vec2(x >= 128 ? 20 : 0, 0);
            flow.pixel(x, y)[0] = d.x, flow.pixel(x, y)[1] = d.y;
        }
    }
    const LatticeField found = fit_flat_motion(flow, weights, 8);
    for (const Vec2 p : {Vec2(10, 10), Vec2(80, 60), Vec2(150, 20), Vec2(140, 110)})
        EXPECT_LT(distance(p + found.at(p), moved(p)), 0.3f) << p.x << " " << p.y;
}

TEST(FlatMotion, IsNoneWhereNothingIsKnown) {
    const LatticeField found = fit_flat_motion(ImageF2(kLeaningFrame), Matte(kLeaningFrame), 8);
    EXPECT_EQ(found.nodes(), LatticeField(kLeaningFrame, 8).nodes());
}

}  // namespace
}  // namespace weft
