#include "engine/metrics/matte_chatter.h"

#include <gtest/gtest.h>

#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

constexpr Size kMatteSize{160, 120};
const Recti kBox{40, 30, 110, 90};

Matte box_moved(int dx, int dy, int wider = 0) {
    return synthetic::rectangle(kMatteSize, {kBox.x0 + dx - wider, kBox.y0 + dy - wider,
                                             kBox.x1 + dx + wider, kBox.y1 + dy + wider});
}

double chatter(const FlowField& motion, const Matte& from, const Matte& to) {
    const auto found = matte_chatter_px(motion, from, to);
    EXPECT_TRUE(found);
    return found.value_or(-1);
}

TEST(MatteChatter, AMatteThatMovesWithItsSurfaceHasNone) {
    const FlowField still = synthetic::constant_motion(kMatteSize, 0, 0);
    const FlowField moving = synthetic::constant_motion(kMatteSize, 5, -3);
    EXPECT_EQ(chatter(still, box_moved(0, 0), box_moved(0, 0)), 0);
    EXPECT_EQ(chatter(moving, box_moved(0, 0), box_moved(5, -3)), 0);
}

TEST(MatteChatter, CountsPixelsByWhichTheEdgeDeparts) {
    const FlowField still = synthetic::constant_motion(kMatteSize, 0, 0);
    EXPECT_NEAR(chatter(still, box_moved(0, 0), box_moved(0, 0, 1)), 1, 0.05);
    EXPECT_NEAR(chatter(still, box_moved(0, 0), box_moved(0, 0, -2)), 2, 0.15);
    // A matte left behind by three pixels: by that much on two of four sides.
    const FlowField moving = synthetic::constant_motion(kMatteSize, 3, 0);
    const double width = kBox.width(), height = kBox.height();
    EXPECT_NEAR(chatter(moving, box_moved(0, 0), box_moved(0, 0)), 3 * height / (width + height),
                0.1);
}

TEST(MatteChatter, LeavesOutWhatIsHiddenAndSaysNothingWithoutAnEdge) {
    FlowField motion = synthetic::constant_motion(kMatteSize, 0, 0);
    // The left half is not known: there the edge may go anywhere.
    for (int y = 0; y < kMatteSize.height; ++y)
        for (int x = 0; x < 75; ++x)
            motion.valid.at(x, y) = 0;
    const Matte cut = synthetic::rectangle(kMatteSize, {60, kBox.y0, kBox.x1, kBox.y1});
    EXPECT_EQ(chatter(motion, box_moved(0, 0), cut), 0);
    EXPECT_FALSE(matte_chatter_px(motion, Matte(kMatteSize, 255), Matte(kMatteSize, 255)));
    motion.valid = Matte(kMatteSize, 0);
    EXPECT_FALSE(matte_chatter_px(motion, box_moved(0, 0), box_moved(0, 0)));
}

}  // namespace
}  // namespace weft
