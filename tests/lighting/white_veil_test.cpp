#include "engine/lighting/white_veil.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace weft {
namespace {

constexpr Size kVeilSize{64, 48};

// Lights from 0.02 to 0.6; the surface, the left half, from 0.02 to 0.3.
SurfaceLightRange range_of(const std::function<float(float)>& seen) {
    ImageF3 picture(kVeilSize);
    Matte surface(kVeilSize);
    for (int y = 0; y < kVeilSize.height; ++y) {
        for (int x = 0; x < kVeilSize.width; ++x) {
            const float light = 0.02f + 0.58f * static_cast<float>(x) / 63;
            for (int c = 0; c < 3; ++c)
                picture.at(x, y, c) = std::clamp(seen(light), 0.0f, 1.0f);
            surface.at(x, y) = x < 32 ? 255 : 0;
        }
    }
    return {light_range(picture, {}), light_range(picture, surface)};
}

float share(const std::function<float(float)>& seen) {
    return white_share(range_of([](float v) { return v; }), range_of(seen));
}

TEST(WhiteVeil, IsTheShareOfWhite) {
    for (const float k : {0.2f, 0.5f, 0.8f, 1.0f})
        EXPECT_NEAR(share([k](float v) { return (1 - k) * v + k; }), k, 0.01f);
}

TEST(WhiteVeil, IsNotMoreOrLessLight) {
    for (const float gain : {0.0f, 0.3f, 1.0f, 1.5f, 3.0f})
        EXPECT_EQ(share([gain](float v) { return gain * v; }), 0) << gain;
    EXPECT_EQ(share([](float v) { return 1e3f * v; }), 1) << "burnt out";
}

TEST(WhiteVeil, IsNotBrightSurroundings) {
    SurfaceLightRange bright = range_of([](float v) { return v; });
    const SurfaceLightRange before = bright;
    bright.picture = {0.7f, 0.8f, 0.9f};
    EXPECT_EQ(white_share(before, bright), 0);
    SurfaceLightRange part = before;
    part.surface = {0.25f, 0.28f, 0.3f};
    EXPECT_EQ(white_share(before, part), 0);
}

TEST(WhiteVeil, WithoutPixelsThereIsNone) {
    EXPECT_EQ(light_range(ImageF3(4, 4, 0.5f), Matte(4, 4)).high, 0);
    EXPECT_EQ(white_share({}, {}), 0);
}

}  // namespace
}  // namespace weft
