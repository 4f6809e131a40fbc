// A board that a pillar hides, and what comes back behind it.
#include "engine/mask/surface_return.h"

#include <gtest/gtest.h>

#include "engine/mask/matte_propagation.h"
#include "tests/mask/moving_disc.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

using test::overlap;

constexpr Size kBoardFrame{320, 200};
constexpr Recti kBoard{130, 60, 200, 140};
constexpr float kPillarWidth = 90, kPillarStep = 9, kPan = 0.6f;

// The camera pans, the pillar passes in front; from `other_from` on another board hangs there.
struct PillarScene {
    int other_from = 1000;

    [[nodiscard]] static Vec2 on_wall(Vec2 p, int t) {
        return p + Vec2(kPan * static_cast<float>(t), 0);
    }
    [[nodiscard]] static bool in_pillar(Vec2 p, int t) {
        const float left = -kPillarWidth + kPillarStep * static_cast<float>(t);
        return p.x >= left && p.x < left + kPillarWidth;
    }
    [[nodiscard]] static bool on_board(Vec2 p, int t) {
        const Vec2 q = on_wall(p, t);
        return q.x >= kBoard.x0 && q.x < kBoard.x1 && q.y >= kBoard.y0 && q.y < kBoard.y1;
    }
    [[nodiscard]] ImageU8x3 frame(int t) const {
        static const WaveTexture wall(1), board(2), other(3), pillar(4);
        ImageU8x3 out(kBoardFrame);
        for (int y = 0; y < kBoardFrame.height; ++y) {
            for (int x = 0; x < kBoardFrame.width; ++x) {
                const Vec2 p = centre_of(x, y), q = on_wall(p, t);
                std::uint8_t* o = out.pixel(x, y);
                if (in_pillar(p, t)) {
                    const float v = pillar(p - Vec2(kPillarStep * static_cast<float>(t), 0));
                    o[0] = o[1] = code_of(0.3f * v);
                    o[2] = code_of(0.5f * v);
                } else if (on_board(p, t)) {
                    const float v = t >= other_from ? other(q) : board(q);
                    o[0] = code_of(v);
                    o[1] = o[2] = code_of(0.6f * v);
                } else {
                    o[0] = o[1] = o[2] = code_of(0.4f + 0.4f * wall(q));
                }
            }
        }
        return out;
    }
    [[nodiscard]] static Matte matte(int t) {
        return draw(kBoardFrame,
                    [&](Vec2 p) { return on_board(p, t) && !in_pillar(p, t) ? 1.0f : 0.0f; });
    }
    [[nodiscard]] static FlowField prev_from_cur(int t) {
        FlowField out(kBoardFrame);
        for (int y = 0; y < kBoardFrame.height; ++y) {
            for (int x = 0; x < kBoardFrame.width; ++x) {
                const bool pillar = in_pillar(centre_of(x, y), t);
                out.d.pixel(x, y)[0] = pillar ? -kPillarStep : kPan;
                out.d.pixel(x, y)[1] = 0;
                out.valid.at(x, y) = 255;
            }
        }
        return out;
    }
};

double share_of_board(const Matte& matte) {
    double sum = 0;
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x)
            sum += matte.at(x, y) / 255.0;
    return sum / (kBoard.width() * kBoard.height());
}

constexpr int kHidden = 22, kBack = 34;  // frames: behind the pillar, and past it

std::vector<Matte> walk_past_pillar(const PillarScene& scene) {
    std::vector<Matte> out{PillarScene::matte(0)};
    MatteWalker walker(scene.frame(0), PillarScene::matte(0));
    for (int t = 1; t <= kBack; ++t)
        out.push_back(walker.advance(scene.frame(t), PillarScene::prev_from_cur(t)).matte);
    return out;
}

TEST(SurfaceReturn, ABoardComesBackFromBehindAPillar) {
    const std::vector<Matte> mattes = walk_past_pillar(PillarScene());
    ASSERT_EQ(share_of_board(PillarScene::matte(kHidden)), 0) << "wholly hidden";
    EXPECT_LT(share_of_board(mattes[kHidden]), 0.02);
    EXPECT_GT(overlap(mattes[kBack], PillarScene::matte(kBack)), 0.93);
    // Not only when all of it is seen.
    EXPECT_GT(overlap(mattes[kBack - 4], PillarScene::matte(kBack - 4)), 0.7);
}

TEST(SurfaceReturn, AnotherBoardInItsPlaceDoesNot) {
    const std::vector<Matte> mattes = walk_past_pillar({.other_from = kHidden});
    EXPECT_LT(share_of_board(mattes[kBack]), 0.02);
}

TEST(SurfaceReturn, WhatIsShownWholeHasNothingToReturn) {
    const PillarScene scene;
    const ImageU8x3 frame = scene.frame(0);
    ImageF1 phi(kBoardFrame, -20);
    for (int y = kBoard.y0; y < kBoard.y1; ++y)
        for (int x = kBoard.x0; x < kBoard.x1; ++x)
            phi.at(x, y) = 20;
    SurfaceReturn back(frame, phi);
    EXPECT_TRUE(back.returned(frame, phi).empty());
    // Of a matte that lost half of it, that half is found.
    ImageF1 lost = phi;
    for (int y = kBoard.y0; y < kBoard.y1; ++y)
        for (int x = kBoard.x0; x < 165; ++x)
            lost.at(x, y) = -20;
    const Matte found = back.returned(frame, lost);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.at(145, 100), 255);
    EXPECT_EQ(found.at(120, 100), 0) << "beside the board";
}

}  // namespace
}  // namespace weft
