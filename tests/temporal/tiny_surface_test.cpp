#include "engine/temporal/tiny_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/temporal/surface_walker.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kTinyFrame{160, 96};
const Vec2 kStart(40, 30);

// A textured rectangle that moves over a still background.
struct Picture {
    Matte luma{kTinyFrame}, matte{kTinyFrame};
};
Picture picture(Vec2 at, Vec2 size) {
    static const WaveTexture back(31), front(32);
    const auto covered = [&](Vec2 p) {
        const Vec2 q = p - at;
        const auto share = [](float v, float end) {
            return std::clamp(std::min(v, end - v) + 0.5f, 0.0f, 1.0f);
        };
        return share(q.x, size.x) * share(q.y, size.y);
    };
    Picture out;
    out.matte = draw(kTinyFrame, covered);
    out.luma = draw(kTinyFrame, [&](Vec2 p) {
        const float share = covered(p);
        return (1 - share) * back(p) + share * front(p - at);
    });
    return out;
}

// The walker's largest error over ten frames, of which the raw motion is the background's.
float largest_error(Vec2 step, Vec2 size) {
    const Picture first = picture(kStart, size);
    SurfaceWalker walker(first.luma, first.matte, {});
    float most = 0;
    for (int k = 1; k < 10; ++k) {
        const Vec2 moved = static_cast<float>(k) * step;
        const Picture now = picture(kStart + moved, size);
        const LatticeField& field = walker.advance(now.luma, now.matte, FlowField(kTinyFrame));
        const Vec2 middle = kStart + moved + 0.5f * size;
        most = std::max(most, distance(field.at(middle), -moved));
    }
    return most;
}

TEST(TinySurface, FollowsAFewPixelsAndNotTheBackground) {
    EXPECT_LT(largest_error({2, 0}, {10, 10}), 0.3f);
    EXPECT_LT(largest_error({-1.5f, 1}, {6, 6}), 0.5f);
    EXPECT_LT(largest_error({0, 0}, {10, 10}), 0.1f);
}

TEST(TinySurface, FollowsThinLinesAcrossAndAlong) {
    EXPECT_LT(largest_error({0, 2}, {70, 2}), 0.3f);
    EXPECT_LT(largest_error({2, 0}, {70, 3}), 0.5f);
    EXPECT_LT(largest_error({1, 0}, {1, 50}), 0.3f);
}

TEST(TinySurface, IsToldByTheFullMatte) {
    const auto tiny = [](Vec2 size, bool hidden) {
        const Picture p = picture(kStart, size);
        const Matte visible = hidden ? picture(kStart, {4, size.y}).matte : p.matte;
        return is_tiny(StepFrame(p.luma, visible, p.matte));
    };
    EXPECT_TRUE(tiny({12, 12}, false));
    EXPECT_TRUE(tiny({90, 5}, false));
    EXPECT_FALSE(tiny({40, 40}, false));
    EXPECT_FALSE(tiny({40, 40}, true)) << "what is seen of a large one beside an occluder";
}

}  // namespace
}  // namespace weft
