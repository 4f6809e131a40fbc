#include "engine/motion/follow_size.h"

#include <gtest/gtest.h>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

TEST(FollowSize, IsThePlatesOwnUpToTheBoundAndOfItsShapeBeyond) {
    EXPECT_EQ(follow_size({854, 480}), (Size{854, 480}));
    EXPECT_EQ(follow_size({960, 540}), (Size{960, 540}));
    EXPECT_EQ(follow_size({1920, 1080}), (Size{960, 540}));
    EXPECT_EQ(follow_size({3840, 2160}), (Size{960, 540}));
    EXPECT_EQ(follow_size({1080, 1920}), (Size{540, 960}));
    EXPECT_EQ(follow_size({1280, 720}), (Size{960, 540}));
    const Size strip = follow_size({16000, 100});
    EXPECT_LE(strip.width * strip.height, 960 * 540 * 11 / 10);
    EXPECT_GE(strip.height, 1);
}

TEST(FollowSize, ReducesToMeans) {
    Matte picture(Size{4, 2});
    for (int k = 0; k < 8; ++k)
        picture.data()[k] = static_cast<std::uint8_t>(20 * k);
    const Matte half = reduced(picture, {2, 1});
    EXPECT_EQ(half.at(0, 0), 50);  // 0, 20, 80, 100
    EXPECT_EQ(half.at(1, 0), 90);
}

TEST(FollowSize, ResizesRawMotionWithItsPixels) {
    FlowField motion(Size{40, 20});
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 40; ++x) {
            motion.d.at(x, y, 0) = 0.1f * static_cast<float>(x);
            motion.d.at(x, y, 1) = -2;
        }
    }
    motion.valid.at(10, 10) = 0;
    const FlowField large = resized(motion, {120, 40});
    // Pixel 61 of 120 lies at 20 of 40; motion is three times as long across, twice down.
    EXPECT_NEAR(large.d.at(61, 20, 0), 3 * 0.1f * 20, 1e-4f);
    EXPECT_NEAR(large.d.at(61, 20, 1), -4, 1e-5f);
    EXPECT_EQ(large.valid.at(31, 20), 0);
    EXPECT_EQ(large.valid.at(37, 20), 255);
    EXPECT_EQ(resized(motion, motion.size()).d, motion.d);
}

TEST(FollowSize, ResizesALatticeExactlyWhereItIsSmooth) {
    LatticeField motion(Size{96, 54}, 8);
    const auto affine = [](Vec2 p) { return Vec2(0.02f * p.x - 0.01f * p.y + 3, 0.03f * p.y - 1); };
    for (int j = 0; j < motion.nodes().height(); ++j) {
        for (int i = 0; i < motion.nodes().width(); ++i)
            motion.set_node(i, j, affine(motion.node_position(i, j)));
    }
    const LatticeField large = resized(motion, {384, 216}, 32);
    for (const Vec2 p : {Vec2(10, 12), Vec2(200, 100), Vec2(380, 210), Vec2(-30, 240)}) {
        const Vec2 expected = 4.0f * affine(0.25f * p);
        EXPECT_NEAR(large.at(p).x, expected.x, 1e-3f);
        EXPECT_NEAR(large.at(p).y, expected.y, 1e-3f);
    }
}

TEST(LatticeField, ManyPositionsAreEachOne) {
    LatticeField field(Size{100, 60}, 8);
    Rng rng(4);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i)
            field.set_node(i, j, Vec2(rng.uniform(), rng.uniform()));
    }
    std::vector<Vec2> positions;
    for (int y = 0; y < 60; y += 7) {
        for (int x = y % 3; x < 100; x += 3)
            positions.push_back(centre_of(x, y));
    }
    positions.emplace_back(99.5f, 0.25f);
    const std::vector<Vec2> found = field.at(positions);
    ASSERT_EQ(found.size(), positions.size());
    for (std::size_t k = 0; k < positions.size(); ++k)
        EXPECT_LT(distance(found[k], field.at(positions[k])), 1e-5f);
}

}  // namespace
}  // namespace weft
