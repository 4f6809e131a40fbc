#include "engine/metrics/drift.h"

#include <gtest/gtest.h>

#include "engine/core/parallel.h"
#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

using synthetic::kSlidSize;
using synthetic::slid_texture;

TEST(Drift, FindsAKnownSlide) {
    const Matte region = synthetic::rectangle(kSlidSize, {20, 20, 180, 140});
    const ResidualMotion slid = residual_motion(slid_texture(0, 0), slid_texture(1.5f, 0), region);
    EXPECT_NEAR(slid.mean_px, 1.5, 0.03);
    EXPECT_NEAR(slid.mean_x_px, 1.5, 0.03);
    EXPECT_NEAR(slid.mean_y_px, 0.0, 0.03);
    EXPECT_GT(slid.patches, 200);
    const ResidualMotion far = residual_motion(slid_texture(0, 0), slid_texture(-4, 5), region);
    EXPECT_NEAR(far.mean_px, 6.403, 0.1);
    EXPECT_NEAR(far.mean_x_px, -4, 0.1);
    const ResidualMotion none =
        residual_motion(slid_texture(3.3f, 0.8f), slid_texture(3.3f, 0.8f), region);
    EXPECT_LT(none.mean_px, 1e-6);
}

TEST(Drift, DoesNotTakeLightForMotion) {
    ImageF1 lit = slid_texture(0.75f, 0);
    for (int y = 0; y < kSlidSize.height; ++y) {
        for (int x = 0; x < kSlidSize.width; ++x)
            lit.at(x, y) *=
                0.5f + 0.5f * static_cast<float>(x) / static_cast<float>(kSlidSize.width);
    }
    const ResidualMotion d = residual_motion(slid_texture(0, 0), lit, Matte(kSlidSize, 255));
    EXPECT_NEAR(d.mean_px, 0.75, 0.05);
}

TEST(Drift, SaysWhenTheTextureIsNotTheSame) {
    const ResidualMotion other =
        residual_motion(slid_texture(0, 0), slid_texture(0, 0, 77), Matte(kSlidSize, 255));
    EXPECT_GT(other.lost, other.patches);
    const ResidualMotion flat = residual_motion(ImageF1(kSlidSize, 90.0f),
                                                ImageF1(kSlidSize, 90.0f), Matte(kSlidSize, 255));
    EXPECT_EQ(flat.patches, 0);
    EXPECT_EQ(flat.lost, 0);
}

}  // namespace
}  // namespace weft
