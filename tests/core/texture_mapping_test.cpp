#include "engine/core/texture_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace weft {
namespace {

// A floor in perspective: texels per pixel grow towards the horizon at y = −250.
const TextureMapping kFloor(Mat3(0.8f, 0.1f, 0, -0.2f, 1.1f, 0.004f, 20, -7, 1));

float distance(Vec2 a, Vec2 b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

TEST(TextureMapping, IsTheIdentityUnlessToldOtherwise) {
    EXPECT_EQ(TextureMapping().texel({12, 34}), Vec2(12, 34));
}

TEST(TextureMapping, TheInverseComesBackToThePixel) {
    for (const Vec2 p : {Vec2(0, 0), Vec2(100, 40), Vec2(17, 230)})
        EXPECT_LT(distance(kFloor.inverse().pixel(kFloor.texel(p)), p), 0.01f);
}

TEST(TextureMapping, ItsLinearPartIsItsDerivative) {
    const Vec2 p(60, 80);
    const TextureMapping::Linear at = kFloor.linear_at(p);
    EXPECT_LT(distance(at.texel, kFloor.texel(p)), 1e-4f);
    for (const Vec2 step : {Vec2(1, 0), Vec2(0, 1), Vec2(-0.6f, 0.8f)}) {
        const Vec2 central = 0.5f * (kFloor.texel(p + step) - kFloor.texel(p - step));
        EXPECT_LT(distance(at.step(step), central), 1e-3f);
        EXPECT_GT(std::hypot(central.x, central.y), 0.3f);
    }
}

// A surface that turns away to the right.
class Bent final : public SurfaceForm {
  public:
    explicit Bent(float share = 1) : share_(share) {}
    [[nodiscard]] Vec2 flat(Vec2 p) const override {
        return {p.x + 0.001f * share_ * p.x * p.x, p.y};
    }
    [[nodiscard]] std::shared_ptr<const SurfaceForm> at_share(float share) const override {
        return std::make_shared<Bent>(share_ * share);
    }

  private:
    float share_;
};

TEST(TextureMapping, AFormActsBeforeThePlacement) {
    const TextureMapping bent = kFloor.with_form(std::make_shared<Bent>());
    const Vec2 p(60, 80);
    EXPECT_LT(distance(bent.texel(p), kFloor.texel({63.6f, 80})), 1e-4f);
    for (const Vec2 step : {Vec2(1, 0), Vec2(0, 1)}) {
        const Vec2 central = 0.5f * (bent.texel(p + step) - bent.texel(p - step));
        EXPECT_LT(distance(bent.linear_at(p).step(step), central), 2e-3f);
    }
    const TextureMapping small = bent.on_smaller_frame(4);
    EXPECT_LT(distance(small.texel(0.25f * p), bent.texel(p)), 1e-3f);
    const auto [low, high] = bent.bounds_of({0, 0, 100, 10});
    EXPECT_GE(high.x, bent.texel({100, 0}).x);
    EXPECT_LE(low.x, bent.texel({0, 10}).x);
    EXPECT_EQ(kFloor.on_surface_of(bent).form(), bent.form());
    EXPECT_LT(distance(kFloor.on_surface_of(bent.on_smaller_frame(2)).texel({30, 40}),
                       kFloor.texel({31.8f, 40})),
              1e-4f);
    EXPECT_EQ(bent.with_form(nullptr), kFloor);
}

TEST(TextureMapping, BoundsHoldEveryTexelThatARectangleShowsAndNoMore) {
    const Recti pixels{10, 20, 90, 70};
    const auto [low, high] = kFloor.bounds_of(pixels);
    Vec2 least(1e9f), most(-1e9f);
    for (int y = pixels.y0; y <= pixels.y1; ++y)
        for (int x = pixels.x0; x <= pixels.x1; ++x) {
            const Vec2 u = kFloor.texel({static_cast<float>(x), static_cast<float>(y)});
            least = glm::min(least, u);
            most = glm::max(most, u);
        }
    EXPECT_LT(distance(low, least), 1e-4f);
    EXPECT_LT(distance(high, most), 1e-4f);
}

TEST(TextureMapping, ASmallerFrameShowsTheSameTexels) {
    const TextureMapping quarter = kFloor.on_smaller_frame(4);
    EXPECT_LT(distance(quarter.texel({15, 20}), kFloor.texel({60, 80})), 1e-3f);
}

}  // namespace
}  // namespace weft
