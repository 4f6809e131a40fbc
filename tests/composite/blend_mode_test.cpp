#include "engine/composite/blend_mode.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "engine/color/color_space.h"
#include "engine/core/luma.h"

namespace weft {
namespace {

ImageF3 flat(float r, float g, float b) {
    ImageF3 out(3, 2);
    for (int k = 0; k < 6; ++k)
        out.data()[3 * k] = r, out.data()[3 * k + 1] = g, out.data()[3 * k + 2] = b;
    return out;
}

ImageF3 blended(const ImageF3& below, ImageF3 layer, BlendMode mode, float opacity = 1) {
    blend_layer(layer, below, Matte(layer.size(), 255), mode, opacity);
    return layer;
}

TEST(BlendMode, NormalAtFullOpacityChangesNoBit) {
    const ImageF3 layer = flat(0.3f, 1.7f, 0), out = blended(flat(1, 0, 0), layer, {});
    EXPECT_EQ(std::memcmp(layer.data(), out.data(), layer.size_bytes()), 0);
}

TEST(BlendMode, OpacityMixesWithWhatIsBelow) {
    const ImageF3 out = blended(flat(1, 0, 0.5f), flat(0, 1, 0.5f), BlendMode::kNormal, 0.25f);
    EXPECT_NEAR(out.at(1, 1, 0), 0.75f, 1e-6f);
    EXPECT_NEAR(out.at(1, 1, 1), 0.25f, 1e-6f);
    EXPECT_NEAR(out.at(1, 1, 2), 0.5f, 1e-6f);
    const ImageF3 none = blended(flat(1, 0, 0.5f), flat(0, 1, 0.5f), BlendMode::kScreen, 0);
    EXPECT_EQ(none.at(0, 0, 0), 1.0f);
}

TEST(BlendMode, MultiplyAndScreenWorkOnLinearLight) {
    const ImageF3 below = flat(0.5f, 0.2f, 3), layer = flat(0.4f, 1, 2);
    const ImageF3 dark = blended(below, layer, BlendMode::kMultiply);
    EXPECT_NEAR(dark.at(0, 0, 0), 0.2f, 1e-6f);
    EXPECT_NEAR(dark.at(0, 0, 1), 0.2f, 1e-6f);
    EXPECT_NEAR(dark.at(0, 0, 2), 6.0f, 1e-5f);
    const ImageF3 light = blended(below, layer, BlendMode::kScreen);
    EXPECT_NEAR(light.at(0, 0, 0), 0.7f, 1e-6f);
    EXPECT_NEAR(light.at(0, 0, 1), 1.0f, 1e-6f);
    EXPECT_NEAR(light.at(0, 0, 2), 3.0f, 1e-6f) << "two values above white do not cancel";
}

TEST(BlendMode, MiddleGreyOfOverlayAndSoftLightChangesNothing) {
    const float half = srgb_to_linear(0.5f);
    const ImageF3 below = flat(0.1f, 0.35f, 0.8f), grey = flat(half, half, half);
    for (const BlendMode mode : {BlendMode::kOverlay, BlendMode::kSoftLight}) {
        const ImageF3 out = blended(below, grey, mode);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(out.at(0, 0, c), below.at(0, 0, c), 2e-3f);
        const ImageF3 bright = blended(below, flat(0.8f, 0.8f, 0.8f), mode);
        EXPECT_GT(bright.at(0, 0, 1), below.at(0, 0, 1));
    }
}

TEST(BlendMode, ColorKeepsTheLuminanceBelow) {
    const ImageF3 below = flat(0.1f, 0.35f, 0.8f);
    const ImageF3 out = blended(below, flat(0.9f, 0.1f, 0.1f), BlendMode::kColor);
    EXPECT_NEAR(luma_709(out.pixel(0, 0)), luma_709(below.pixel(0, 0)), 1e-5f);
    EXPECT_NEAR(out.at(0, 0, 0) / out.at(0, 0, 1), 9.0f, 1e-3f);
}

TEST(BlendMode, LeavesTheLayerWhereNothingIsBelow) {
    ImageF3 below = flat(0.5f, 0.5f, 0.5f), layer = flat(0.2f, 0.2f, 0.2f);
    below.at(0, 0, 1) = std::numeric_limits<float>::infinity();
    Matte matte(below.size(), 255);
    matte.at(1, 0) = 0;
    blend_layer(layer, below, matte, BlendMode::kMultiply, 1);
    EXPECT_EQ(layer.at(0, 0, 0), 0.2f);
    EXPECT_EQ(layer.at(1, 0, 0), 0.2f);
    EXPECT_NEAR(layer.at(2, 0, 0), 0.1f, 1e-6f);
}

}  // namespace
}  // namespace weft
