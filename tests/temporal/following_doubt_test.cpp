#include "engine/temporal/following_doubt.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "engine/temporal/surface_walker.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

void note(FollowingDoubt& doubt, double residual, int frames, int replaced_every) {
    for (int frame = 1; frame <= frames; ++frame) {
        doubt.note({.residual = residual});
        if (frame % replaced_every == 0) doubt.note_replaced();
    }
}

TEST(FollowingDoubt, NeedsPoorFramesAndAnchorsThatDoNotLast) {
    constexpr int kNever = 1000;
    FollowingDoubt doubt;
    EXPECT_EQ(doubt.share(), 0);
    note(doubt, 0.6, 40, kNever);
    EXPECT_EQ(doubt.share(), 0);  // one anchor that goes on showing it
    note(doubt, 0.3, 40, 3);
    EXPECT_EQ(doubt.share(), 0);  // what comes into view quickly, and is found well
    note(doubt, 0.5, 1, 1);
    EXPECT_EQ(doubt.share(), 0);
    note(doubt, 0.5, 12, 3);
    EXPECT_GT(doubt.share(), 0.9f);
    note(doubt, 0.3, 20, kNever);
    EXPECT_EQ(doubt.share(), 0);
}

constexpr Size kSheet{256, 176};
constexpr float kWider = 1.1f;  // a frame

// What draws the texture out by a tenth a frame.
FlowField widening() {
    FlowField flow(kSheet);
    for (int y = 0; y < kSheet.height; ++y) {
        for (int x = 0; x < kSheet.width; ++x) {
            flow.d.at(x, y, 0) = (1 / kWider - 1) * (static_cast<float>(x) + 0.5f - 128);
            flow.valid.at(x, y) = 255;
        }
    }
    return flow;
}

// How many times wider than on the first frame the texture lies on the ninth. If it `turns`, what
// shows goes within two frames and something else comes.
float width_after_nine_steps(bool turns) {
    const auto luma_at = [&](int t) {
        const float width = std::pow(kWider, static_cast<float>(t));
        const int first = turns ? t : 0;
        const std::array<WaveTexture, 2> shown{WaveTexture(7 + first), WaveTexture(8 + first)};
        return draw(kSheet, [&](Vec2 p) {
            float sum = 0;
            for (const WaveTexture& one : shown)
                sum += one({128 + (p.x - 128) / width, p.y});
            return 0.5f + 0.5f * (sum - 1);
        });
    };
    const Matte visible =
        draw(kSheet, [&](Vec2 p) { return std::abs(p.x - 128) < 100 ? 1.0f : 0.0f; });
    SurfaceWalkerOptions options;
    options.kind = SurfaceKind::kCloth;
    SurfaceWalker walker(luma_at(0), visible, options);
    for (int t = 1; t <= 9; ++t)
        walker.advance(luma_at(t), visible, widening());
    const LatticeField& ref_from_cur = walker.ref_from_cur();
    return 16 / (16 + ref_from_cur.at({136, 88}).x - ref_from_cur.at({120, 88}).x);
}

// Motion that draws the texture out is believed while the picture is found again under it.
TEST(FollowingDoubt, KeepsATextureInShapeThatNothingHolds) {
    EXPECT_GT(width_after_nine_steps(false), 2.3f);
    EXPECT_LT(width_after_nine_steps(true), 2.1f);
}

}  // namespace
}  // namespace weft
