// What a frame was composited from, as other programs put it together again.
#include "engine/pipeline/frame_layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/pipeline/st_rim.h"

namespace weft {
namespace {

// As OpenEXR stores a half: 11 bits, the nearest.
float stored(float value) {
    if (value == 0) return 0;
    const int step = std::max(std::ilogb(value) - 10, -24);
    return std::ldexp(std::nearbyint(std::ldexp(value, -step)), step);
}

TEST(FrameLayers, TheFinishIsTheRestOfTheWayToThePatch) {
    FrameLayers layers({16, 16});
    std::mt19937 numbers(7);
    const auto number = [&] { return static_cast<float>(numbers() % 10007) / 10007.0f; };
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            layers.alpha.at(x, y) = x == 0 ? 0.0f : x < 4 ? number() : 1.0f;
            for (int c = 0; c < 3; ++c) {
                layers.texture.at(x, y, c) = number();
                layers.light.at(x, y, c) = 3 * number();
                layers.gloss.at(x, y, c) = number() / 4;
                layers.patch.at(x, y, c) = layers.alpha.at(x, y) * 2 * number();
            }
        }
    }
    note_finish(layers);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            const float alpha = stored(layers.alpha.at(x, y));
            for (int c = 0; c < 3; ++c) {
                if (alpha == 0) {
                    EXPECT_EQ(layers.finish.at(x, y, c), 0);
                    continue;
                }
                const float again =
                    alpha * (stored(layers.texture.at(x, y, c)) * stored(layers.light.at(x, y, c)) +
                             stored(layers.gloss.at(x, y, c)) + stored(layers.finish.at(x, y, c)));
                EXPECT_NEAR(again, layers.patch.at(x, y, c), 1.0f / 1024) << x << ", " << y;
            }
        }
    }
}

TEST(StRim, AMapGoesOnEvenlyForTwoPixels) {
    ImageF2 st(20, 20);
    ImageF1 known(20, 20);
    const auto place = [](int x, int y, int c) {
        return c == 0 ? 0.01f * static_cast<float>(x + 3) + 0.002f * static_cast<float>(y)
                      : 0.9f - 0.02f * static_cast<float>(y);
    };
    for (int y = 8; y < 14; ++y) {
        for (int x = 6; x < 12; ++x) {
            known.at(x, y) = x == 6 ? 0.2f : 1.0f;
            for (int c = 0; c < 2; ++c)
                st.at(x, y, c) = place(x, y, c);
        }
    }
    continue_map(st, known);
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) {
            const bool near = x >= 4 && x < 14 && y >= 6 && y < 16;
            for (int c = 0; c < 2; ++c)
                EXPECT_NEAR(st.at(x, y, c), near ? place(x, y, c) : 0.0f, 1e-5f) << x << ", " << y;
        }
    }
}

// From the end of a texture that repeats to its beginning.
TEST(StRim, AJumpIsNotContinued) {
    ImageF2 st(8, 1);
    ImageF1 known(8, 1);
    for (int x = 2; x < 5; ++x) {
        known.at(x, 0) = 1;
        st.at(x, 0, 0) = x < 4 ? 0.97f + 0.01f * static_cast<float>(x - 2) : 0.0f;
        st.at(x, 0, 1) = 0.5f;
    }
    continue_map(st, known);
    EXPECT_NEAR(st.at(5, 0, 0), 0, 1e-6f) << "not -0.98";
    EXPECT_NEAR(st.at(1, 0, 0), 0.96f, 1e-5f);
}

}  // namespace
}  // namespace weft
