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

// A floor whose horizon crosses the frame above what is seen of it.
TEST(Flattened, StaysTameBeyondItsHorizon) {
    const auto on_floor = [](Vec2 p) {
        const float depth = 0.02f * (p.y - 40);
        return Vec2(80 + (p.x - 80) / depth, 40 + 100 / depth);
    };
    Matte seen(kLeaningFrame);
    LatticeField floor(kLeaningFrame, 8);
    for (int y = 70; y < kLeaningFrame.height; ++y) {
        for (int x = 0; x < kLeaningFrame.width; ++x)
            seen.at(x, y) = 255;
    }
    for (int j = 0; j < floor.nodes().height(); ++j) {
        for (int i = 0; i < floor.nodes().width(); ++i) {
            const Vec2 p = floor.node_position(i, j);
            if (p.y > 48) floor.set_node(i, j, on_floor(p) - p);
        }
    }
    const LatticeField found = flattened(floor, seen);
    for (const Vec2 p : {Vec2(20, 80), Vec2(80, 100), Vec2(150, 90)})
        EXPECT_LT(distance(p + found.at(p), on_floor(p)), 0.5f) << p.x << " " << p.y;
    for (int j = 0; j < found.nodes().height(); ++j) {
        for (int i = 0; i < found.nodes().width(); ++i)
            EXPECT_LT(glm::length(found.node(i, j)), 1000) << i << " " << j;
    }
}

}  // namespace
}  // namespace weft
