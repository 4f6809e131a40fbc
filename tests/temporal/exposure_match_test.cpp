#include "engine/temporal/exposure_match.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/motion/motion_blur.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kPanFrame{256, 144};

// A pan that begins: what a frame shows is `pan(t)` px further left.
float pan(int t) {
    return 1.5f * static_cast<float>(t * t);
}
Vec2 speed(int t) {
    return {pan(t) - pan(t - 1), 0};
}

// The frames that a shutter makes that is open for `share` of a frame, with grain.
std::shared_ptr<const StepFrame> exposed_frame(int t, float share) {
    const WaveTexture texture(21);
    const Matte all = draw(kPanFrame, [](Vec2) { return 1.0f; });
    const Matte sharp =
        draw(kPanFrame, [&](Vec2 p) { return texture((p + Vec2(pan(t), 0)) * 0.9f); });
    ExposedFrame taken =
        exposed_along(sharp, all, moved_by(kPanFrame, t == 0 ? Vec2(0) : share * speed(t)));
    Rng grain(static_cast<std::uint64_t>(t));
    for (int y = 0; y < kPanFrame.height; ++y) {
        for (int x = 0; x < kPanFrame.width; ++x) {
            const double level = taken.luma.at(x, y) + 8 * (grain.uniform() - 0.5);
            taken.luma.at(x, y) = static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0));
        }
    }
    return std::make_shared<const StepFrame>(taken.luma, all, all);
}

struct Learnt {
    ExposureMatch match;
    Anchor anchor;
};

Learnt learn(float share, int first, int last, float miss_px = 0) {
    Learnt out;
    out.anchor = {exposed_frame(first, share), LatticeField(kPanFrame, 8), 0,
                  moved_by(kPanFrame, first == 0 ? Vec2(0) : speed(first))};
    for (int t = first + 1; t <= last; ++t) {
        const Vec2 way(pan(t) - pan(first) + miss_px, 0);
        out.match.learn(out.anchor, *exposed_frame(t, share), moved_by(kPanFrame, speed(t)),
                        moved_by(kPanFrame, way));
    }
    return out;
}

TEST(ExposureMatch, FindsHowLongTheShutterIsOpen) {
    EXPECT_EQ(learn(0.5f, 0, 6).match.open_share(), 0.5f);
    EXPECT_EQ(learn(0.25f, 0, 6).match.open_share(), 0.25f);
}

// Any blur makes grain and small misses agree better.
TEST(ExposureMatch, FindsNoBlurWhereThereIsNone) {
    EXPECT_EQ(learn(0, 0, 6).match.open_share(), 0);
    EXPECT_EQ(learn(0, 0, 6, 1.5f).match.open_share(), 0);
}

TEST(ExposureMatch, LearnsNothingFromFramesThatMoveAlike) {
    EXPECT_EQ(learn(0.5f, 6, 7).match.open_share(), 0);
}

TEST(ExposureMatch, RegistersABlurredFrameOnASharpOne) {
    constexpr float kShare = 0.5f;
    constexpr int kLastFrame = 6;
    const Learnt learnt = learn(kShare, 0, kLastFrame);
    const auto cur = exposed_frame(kLastFrame, kShare);
    const LatticeField motion = moved_by(kPanFrame, speed(kLastFrame));
    const LatticeField expected = moved_by(kPanFrame, {pan(kLastFrame) + 0.5f, 0.3f});
    const Registered sharp =
        register_against(learnt.anchor, *cur, false, expected, FlowQuality::kFinal);
    const auto alike =
        learnt.match.registered(learnt.anchor, *cur, motion, expected, sharp, FlowQuality::kFinal);
    ASSERT_TRUE(alike);
    EXPECT_LT(alike->fit.residual, 0.7 * sharp.fit.residual);
    for (const Vec2 p : {Vec2(60, 40), Vec2(120, 72), Vec2(150, 110)}) {
        const Vec2 truth(pan(kLastFrame), 0);
        EXPECT_LT(distance(alike->anchor_from_cur.at(p), truth), 0.15f);
    }
}

TEST(ExposureMatch, LeavesSharpFramesAsTheyAre) {
    const Learnt learnt = learn(0, 0, 6);
    const auto cur = exposed_frame(6, 0);
    const LatticeField expected = moved_by(kPanFrame, {pan(6), 0});
    const Registered sharp =
        register_against(learnt.anchor, *cur, false, expected, FlowQuality::kFinal);
    EXPECT_FALSE(learnt.match.registered(learnt.anchor, *cur, moved_by(kPanFrame, speed(6)),
                                         expected, sharp, FlowQuality::kFinal));
}

}  // namespace
}  // namespace weft
