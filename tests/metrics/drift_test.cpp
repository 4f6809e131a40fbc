#include "engine/metrics/drift.h"

#include <gtest/gtest.h>

#include "engine/core/parallel.h"
#include "engine/metrics/ideal.h"
#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

constexpr Size kSize{200, 160};

ImageF1 texture_at(float dx, float dy, std::uint64_t seed = 5) {
    // What the plane shows when it has slid by (dx, dy).
    return IdealTexture(synthetic::blobs(128, seed))
        .render_luma(synthetic::constant_motion(kSize, -dx, -dy), {});
}

TEST(Drift, FindsAKnownSlide) {
    const Matte region = synthetic::rectangle(kSize, {20, 20, 180, 140});
    const ResidualMotion slid = residual_motion(texture_at(0, 0), texture_at(1.5f, 0), region);
    EXPECT_NEAR(slid.mean_px, 1.5, 0.03);
    EXPECT_NEAR(slid.mean_x_px, 1.5, 0.03);
    EXPECT_NEAR(slid.mean_y_px, 0.0, 0.03);
    EXPECT_GT(slid.patches, 200);
    const ResidualMotion far = residual_motion(texture_at(0, 0), texture_at(-4, 5), region);
    EXPECT_NEAR(far.mean_px, 6.403, 0.1);
    EXPECT_NEAR(far.mean_x_px, -4, 0.1);
    const ResidualMotion none =
        residual_motion(texture_at(3.3f, 0.8f), texture_at(3.3f, 0.8f), region);
    EXPECT_LT(none.mean_px, 1e-6);
}

TEST(Drift, DoesNotTakeLightForMotion) {
    ImageF1 lit = texture_at(0.75f, 0);
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x)
            lit.at(x, y) *= 0.5f + 0.5f * static_cast<float>(x) / static_cast<float>(kSize.width);
    }
    const ResidualMotion d = residual_motion(texture_at(0, 0), lit, Matte(kSize, 255));
    EXPECT_NEAR(d.mean_px, 0.75, 0.05);
}

TEST(Drift, SaysWhenTheTextureIsNotTheSame) {
    const ResidualMotion other =
        residual_motion(texture_at(0, 0), texture_at(0, 0, 77), Matte(kSize, 255));
    EXPECT_GT(other.lost, other.patches);
    const ResidualMotion flat =
        residual_motion(ImageF1(kSize, 90.0f), ImageF1(kSize, 90.0f), Matte(kSize, 255));
    EXPECT_EQ(flat.patches, 0);
    EXPECT_EQ(flat.lost, 0);
}

}  // namespace
}  // namespace weft
