// Mattes that were found on a smaller plate get their edge from the larger one.
#include "engine/mask/plate_edge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/motion/follow_size.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

using test::DiscScene;
using test::overlap;

DiscScene large_disc() {
    return {.size = {480, 360}, .radius_px = 90, .start = {210.3f, 171.8f}};
}

// Of every pixel, apart from those within `near_px` of the disc's edge.
int wrong_pixels(const Matte& found, const DiscScene& scene, float near_px) {
    int wrong = 0;
    for (int y = 0; y < found.height(); ++y) {
        for (int x = 0; x < found.width(); ++x) {
            const float d = scene.radius_px - glm::length(Vec2(x, y) - scene.center(0));
            if (std::abs(d) > near_px) wrong += found.at(x, y) != (d > 0 ? 255 : 0);
        }
    }
    return wrong;
}

// The disc as it was found on a plate of a `factor`th, `off_px` of that too large.
Matte found_small(const DiscScene& scene, int factor, float off_px) {
    DiscScene larger = scene;
    larger.radius_px += off_px * static_cast<float>(factor);
    const Size size = scene.size;
    return reduced(larger.matte(0), {size.width / factor, size.height / factor});
}

TEST(PlateEdge, LiesOnTheEdgeOfTheLargerPlate) {
    const DiscScene scene = large_disc();
    for (const int factor : {2, 4}) {
        for (const float off_px : {-0.7f, 0.0f, 0.7f}) {
            SCOPED_TRACE(std::to_string(factor) + " " + std::to_string(off_px));
            const Matte small = found_small(scene, factor, off_px);
            const Matte found = at_plate_size(small, scene.frame(0), {}, {.soft_edges = false});
            EXPECT_GT(overlap(found, scene.matte(0)), 0.99);
            EXPECT_EQ(wrong_pixels(found, scene, 3), 0);
        }
    }
}

// Of a plate without an edge, the enlarged matte is all that is known.
TEST(PlateEdge, StaysWhereThePlateShowsNone) {
    const DiscScene scene = large_disc();
    ImageU8x3 flat(scene.size);
    for (int y = 0; y < flat.height(); ++y)
        std::fill_n(flat.row(y), 3 * flat.width(), std::uint8_t{120});
    const Matte small = found_small(scene, 4, 0);
    const Matte found = at_plate_size(small, flat, {}, {.soft_edges = false});
    EXPECT_GT(overlap(found, scene.matte(0)), 0.985);
    EXPECT_EQ(wrong_pixels(found, scene, 3), 0);
}

// Where something in front hides the edge, its own edge is not taken for it.
TEST(PlateEdge, StaysBehindWhatIsInFront) {
    const DiscScene scene = large_disc();
    constexpr int kFactor = 4;
    ImageU8x3 frame = scene.frame(0);
    Matte front(scene.size);
    const int edge = static_cast<int>(scene.center(0).x + scene.radius_px);
    for (int y = 0; y < frame.height(); ++y) {
        for (int x = edge - 4; x < edge + 40; ++x) {
            front.at(x, y) = 255;
            for (int c = 0; c < 3; ++c)
                frame.at(x, y, c) = 20;
        }
    }
    const Matte small = found_small(scene, kFactor, 0);
    const Matte found = at_plate_size(small, frame, front, {.soft_edges = false});
    EXPECT_EQ(wrong_pixels(found, scene, kFactor), 0);
    const Matte misled = at_plate_size(small, frame, {}, {.soft_edges = false});
    EXPECT_GT(wrong_pixels(misled, scene, kFactor), 0) << "the front is seen";
}

// An edge that is soft over many pixels stays as soft; one that is not known to be gets hard.
// `half_width_px`: of the larger plate.
void expect_soft(float half_width_px) {
    SCOPED_TRACE(half_width_px);
    const DiscScene scene = large_disc();
    Matte soft(scene.size);
    ImageU8x3 frame(scene.size);
    for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
            const float d = scene.radius_px - glm::length(Vec2(x, y) - scene.center(0));
            const float a = std::clamp(0.5f + 0.5f * d / half_width_px, 0.0f, 1.0f);
            soft.at(x, y) = static_cast<std::uint8_t>(std::lround(255 * a));
            for (int c = 0; c < 3; ++c)
                frame.at(x, y, c) = static_cast<std::uint8_t>(std::lround(40 + 160 * a));
        }
    }
    const Matte small = reduced(soft, {120, 90});
    const Matte found = at_plate_size(small, frame, {}, {.soft_edges = true});
    double error = 0;
    int n = 0, lost = 0;
    for (int y = 0; y < found.height(); ++y) {
        for (int x = 0; x < found.width(); ++x) {
            const float d = scene.radius_px - glm::length(Vec2(x, y) - scene.center(0));
            if (std::abs(d) > half_width_px) continue;
            error += std::abs(found.at(x, y) - soft.at(x, y));
            lost += soft.at(x, y) > 40 && found.at(x, y) == 0;
            ++n;
        }
    }
    EXPECT_LT(error / n, 10);
    EXPECT_LT(lost, n / 500) << "of the far end of the edge";
}

TEST(PlateEdge, KeepsSoftEdgesSoft) {
    expect_soft(16);
    expect_soft(70);
}

TEST(PlateEdge, AnEmptyMatteStaysEmpty) {
    const Matte found = at_plate_size(Matte(40, 30), ImageU8x3(160, 120), {}, {});
    EXPECT_EQ(found, Matte(160, 120));
}

}  // namespace
}  // namespace weft
