#include "engine/motion/motion_blur.h"

#include <gtest/gtest.h>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kBlurFrame{160, 120};

Matte all() {
    return draw(kBlurFrame, [](Vec2) { return 1.0f; });
}

template <class F>
float mean_of(const F& texture, Vec2 p, Vec2 way) {
    constexpr int kSteps = 200;
    float sum = 0;
    for (int k = 0; k < kSteps; ++k)
        sum += texture(p + way * ((static_cast<float>(k) + 0.5f) / kSteps - 0.5f));
    return sum / kSteps;
}

TEST(MotionBlur, IsTheMeanAlongTheWay) {
    // Of long waves, within the range of codes.
    const WaveTexture waves(3);
    const auto texture = [&](Vec2 p) { return 0.25f + 0.5f * waves(p * 0.5f); };
    const Matte sharp = draw(kBlurFrame, texture);
    const Vec2 way(9, -5);
    const ExposedFrame blurred = exposed_along(sharp, all(), moved_by(kBlurFrame, way));
    for (int y = 20; y < 100; y += 7) {
        for (int x = 20; x < 140; x += 7) {
            EXPECT_NEAR(blurred.luma.at(x, y), code_of(mean_of(texture, centre_of(x, y), way)), 1);
        }
    }
}

TEST(MotionBlur, OfNoMotionIsThePictureItself) {
    const Matte sharp = draw(kBlurFrame, WaveTexture(4));
    const ExposedFrame same = exposed_along(sharp, all(), LatticeField(kBlurFrame, 8));
    EXPECT_EQ(same.luma, sharp);
    EXPECT_EQ(same.visible, all());
}

TEST(MotionBlur, ShowsNothingButTheSurfaceWhereTheWholeWayLiesInIt) {
    const Matte half = draw(kBlurFrame, [](Vec2 p) { return p.x < 80 ? 1.0f : 0.0f; });
    const ExposedFrame blurred =
        exposed_along(draw(kBlurFrame, WaveTexture(5)), half, moved_by(kBlurFrame, {20, 0}));
    for (int x = 0; x < kBlurFrame.width; ++x) {
        if (std::abs(x - 10) > 1 && std::abs(x - 70) > 1) {
            EXPECT_EQ(blurred.visible.at(x, 60) != 0, x > 10 && x < 70) << x;
        }
    }
}

TEST(MotionBlur, MotionIsAsLargeAsTheOtherFrameShowsIt) {
    // There everything is twice as large as here.
    LatticeField there_from_here(kBlurFrame, 8), here_from_there(kBlurFrame, 8);
    for (int j = 0; j < there_from_here.nodes().height(); ++j) {
        for (int i = 0; i < there_from_here.nodes().width(); ++i) {
            const Vec2 p = there_from_here.node_position(i, j);
            there_from_here.set_node(i, j, p);
            here_from_there.set_node(i, j, -0.5f * p);
        }
    }
    const LatticeField seen =
        motion_seen_from(moved_by(kBlurFrame, {12, -4}), there_from_here, here_from_there);
    EXPECT_LT(distance(seen.at({40, 30}), {6, -2}), 1e-4f);
}

}  // namespace
}  // namespace weft
