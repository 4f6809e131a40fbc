// A walk whose surface came back looking otherwise, so that it is not found.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/temporal/surface_walker.h"
#include "tests/motion/pictures.h"
#include "tests/temporal/picture_flow.h"

namespace weft {
namespace {

constexpr Size kSearchedFrame{256, 176};

// What is there instead gets narrower by 15 % a frame: its steps alone would draw the texture out
// to 3.7 times its width.
TEST(WalkSearch, StepsOfALostSurfaceDoNotDrawItOut) {
    const WaveTexture own(12), other(77);
    const Matte seen = draw(kSearchedFrame, [](Vec2 p) {
        return std::abs(p.x - 128) < 60 && std::abs(p.y - 88) < 50 ? 1.0f : 0.0f;
    });
    const auto luma_at = [&](int t) {
        const float width = std::pow(0.85f, static_cast<float>(t - 4));
        return draw(kSearchedFrame, [&](Vec2 p) {
            return t < 3 ? own(p) : other({128 + (p.x - 128) / width, 1.3f * p.y});
        });
    };
    SurfaceWalkerOptions options;
    options.kind = SurfaceKind::kCloth;
    SurfaceWalker walker(luma_at(0), seen, options);
    for (int t = 1; t <= 12; ++t) {
        const bool hidden = t == 3 || t == 4;
        walker.advance(luma_at(t), hidden ? Matte(kSearchedFrame) : seen,
                       flow_between(luma_at(t), luma_at(t - 1)));
    }
    const LatticeField& field = walker.ref_from_cur();
    const float across = 1 + (field.at({158, 88}).x - field.at({98, 88}).x) / 60;
    const float down = 1 + (field.at({128, 113}).y - field.at({128, 63}).y) / 50;
    EXPECT_LT(std::max(across / down, down / across), 1.5f) << across << " " << down;
}

}  // namespace
}  // namespace weft
