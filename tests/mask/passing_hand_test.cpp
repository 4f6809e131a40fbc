// A hand comes over a pale jacket from the picture's border and goes again. The wall above is as
// pale as the jacket, so that colours tell the hand from both, but not one from the other.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/core/rng.h"
#include "engine/mask/matte_propagation.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

class PassingHand {
  public:
    static constexpr Size kSize{240, 180};
    static constexpr int kGone = 10, kEnd = 16;

    [[nodiscard]] bool on_hand(int x, int y, int t) const {
        const Vec2 d = Vec2(x, y) - center(t);
        return glm::length(d) < kRadius_px;
    }
    [[nodiscard]] Matte jacket(int t) const {
        Matte out(kSize);
        for (int y = kCollar; y < kSize.height; ++y)
            for (int x = 0; x < kSize.width; ++x)
                out.at(x, y) = on_hand(x, y, t) ? 0 : 255;
        return out;
    }
    // As somebody paints it who does not look: a strip of the chin is in it.
    [[nodiscard]] Matte painted_loosely() const {
        Matte out = jacket(0);
        for (int y = kChin - 20; y < kCollar; ++y)
            std::fill(out.row(y) + 86, out.row(y) + 134, std::uint8_t{255});
        return out;
    }
    [[nodiscard]] ImageU8x3 frame(int t) const {
        ImageU8x3 out(kSize);
        for (int y = 0; y < out.height(); ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const bool face = y < kChin && std::abs(x - 110) < 26;
                const bool hand = on_hand(x, y, t);
                const Vec3 cloth(188, 184, 176), wall(192, 189, 184), skin(186, 128, 98);
                const Vec3 base = hand || face ? skin : y >= kCollar ? cloth : wall;
                // Folds of the jacket, edges of the wall.
                const float wave = 7 * std::sin(0.13f * static_cast<float>(x)) *
                                   std::sin(0.09f * static_cast<float>(x + 2 * y));
                Rng grain(5, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x));
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) = static_cast<std::uint8_t>(base[c] + (hand ? 0.0f : wave) +
                                                                static_cast<float>(grain.below(5)));
            }
        }
        return out;
    }
    // True motion; what is seen for the first time has none.
    [[nodiscard]] FlowField motion(int t) const {
        FlowField out(kSize);
        const Vec2 step = center(t - 1) - center(t);
        for (int y = 0; y < out.d.height(); ++y) {
            for (int x = 0; x < out.d.width(); ++x) {
                const bool now = on_hand(x, y, t), before = on_hand(x, y, t - 1);
                if (now) {
                    out.d.at(x, y, 0) = step.x;
                    out.d.at(x, y, 1) = step.y;
                }
                const Vec2 from = Vec2(x, y) + step;
                const bool came_in = now && from.y > static_cast<float>(kSize.height - 1);
                if (came_in || (before && !now)) out.valid.at(x, y) = 0;
            }
        }
        return out;
    }

  private:
    static constexpr int kCollar = 70, kChin = 62;
    static constexpr float kRadius_px = 24;

    // Up by 14 px a frame, and down again.
    [[nodiscard]] static Vec2 center(int t) {
        const int rise = std::min(t, kGone - t);
        return {120, 206 - 14 * static_cast<float>(std::max(rise, 0))};
    }
};

// How much of the hand a matte has, where enough of it is seen.
double taken_of_hand(const PassingHand& clip, int t, const Matte& found) {
    double hand = 0, taken = 0;
    for (int y = 0; y < found.height(); ++y) {
        for (int x = 0; x < found.width(); ++x) {
            if (!clip.on_hand(x, y, t)) continue;
            hand += 1;
            taken += found.at(x, y) > 127 ? 1 : 0;
        }
    }
    return hand > 400 ? taken / hand : 0;
}

TEST(PassingHand, IsCutOutAndGivesTheJacketBack) {
    const PassingHand clip;
    MatteWalker walker(clip.frame(0), clip.jacket(0));
    for (int t = 1; t <= PassingHand::kEnd; ++t) {
        const Matte found = walker.advance(clip.frame(t), clip.motion(t)).matte;
        const Matte truth = clip.jacket(t);
        EXPECT_LT(taken_of_hand(clip, t, found), 0.15) << t;
        if (t > PassingHand::kGone + 2) {
            EXPECT_GT(test::overlap(found, truth), 0.985) << t;
        }
    }
}

TEST(PassingHand, IsCutOutThoughALittleSkinWasPaintedWithTheJacket) {
    const PassingHand clip;
    MatteWalker walker(clip.frame(0), clip.painted_loosely());
    for (int t = 1; t < PassingHand::kGone; ++t) {
        const Matte found = walker.advance(clip.frame(t), clip.motion(t)).matte;
        EXPECT_LT(taken_of_hand(clip, t, found), 0.15) << t;
    }
}

// Though black was seen outside the jacket.
TEST(PassingHand, ABlackFrameLosesNothing) {
    const PassingHand clip;
    ImageU8x3 first = clip.frame(0);
    for (int y = 0; y < 50; ++y)
        std::fill(first.row(y), first.row(y) + 150, std::uint8_t{3});  // a dark curtain
    MatteWalker walker(first, clip.jacket(0));
    FlowField lost(PassingHand::kSize), rests(PassingHand::kSize);
    std::fill(lost.valid.data(), lost.valid.data() + lost.valid.size_bytes(), std::uint8_t{0});
    const ImageU8x3 black(PassingHand::kSize);
    EXPECT_GT(test::overlap(walker.advance(first, rests).matte, clip.jacket(0)), 0.985);
    const Matte dark = walker.advance(black, lost).matte;
    EXPECT_GT(test::overlap(dark, clip.jacket(0)), 0.9);
    EXPECT_GT(test::overlap(walker.advance(first, lost).matte, clip.jacket(0)), 0.87);
}

}  // namespace
}  // namespace weft
