// The colour of the light of a whole frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/core/rng.h"
#include "engine/lighting/plate_tint.h"

namespace weft {
namespace {

using Colour = std::array<float, 3>;

// Squares of paint, a third of them in shade, where another light falls. The paints' colours differ
// are `darkest` to seven times that.
ImageF3 paints(const Colour& light, const Colour& shade_light,
               const Colour& darkest = {0.1f, 0.1f, 0.1f}) {
    constexpr int kSquare = 8;
    ImageF3 out(160, 120);
    Rng rng(5);
    for (int v = 0; v < out.height(); v += kSquare) {
        for (int u = 0; u < out.width(); u += kSquare) {
            const Colour& here = rng.uniform() < 0.33 ? shade_light : light;
            Colour paint = darkest;
            for (float& p : paint)
                p += 0.6f * static_cast<float>(rng.uniform()) * p / 0.1f;
            for (int y = v; y < v + kSquare; ++y) {
                for (int x = u; x < u + kSquare; ++x) {
                    for (std::size_t c = 0; c < 3; ++c)
                        out.pixel(x, y)[c] = paint[c] * here[c];
                }
            }
        }
    }
    return out;
}

float luminance(const Colour& c) {
    return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
}

TEST(PlateTint, PaintsOfAllColoursUnderWhiteLightHaveNone) {
    EXPECT_EQ(plate_tint(paints({0.9f, 0.9f, 0.9f}, {0.2f, 0.2f, 0.3f})), (Colour{0, 0, 0}));
}

TEST(PlateTint, OneWarmMaterialIsNoEvening) {
    // Bricks: no blue in them anywhere, in the shade neither.
    const Colour brick{0.1f, 0.05f, 0.01f};
    EXPECT_EQ(plate_tint(paints({0.9f, 0.9f, 0.9f}, {0.2f, 0.2f, 0.2f}, brick)), (Colour{0, 0, 0}));
}

TEST(LikelyTint, IsALargePartOfALampsColourAndNoneOfOneMaterials) {
    const Colour lamp{0.9f, 0.75f, 0.6f}, shade{0.2f, 0.2f, 0.22f};
    const Colour tint = likely_tint(paints(lamp, shade));
    const float red = std::log(lamp[0] / lamp[1]), blue = std::log(lamp[2] / lamp[1]);
    EXPECT_GT(tint[0] - tint[1], 0.3f * red);
    EXPECT_LT(tint[0] - tint[1], red);
    EXPECT_LT(tint[2] - tint[1], 0.3f * blue);
    EXPECT_GT(tint[2] - tint[1], blue);
    const Colour brick{0.1f, 0.05f, 0.01f};
    EXPECT_EQ(likely_tint(paints({0.9f, 0.9f, 0.9f}, {0.2f, 0.2f, 0.2f}, brick)),
              (Colour{0, 0, 0}));
}

TEST(PlateTint, AnEveningSunIsOrangeWhateverItsStrength) {
    // So orange that the bluest of these paints is not blue any more; the sky lights the shade.
    for (const float strength : {1.0f, 20.0f}) {
        const Colour sun{strength, 0.5f * strength, 0.08f * strength};
        const Colour sky{0.08f * strength, 0.1f * strength, 0.14f * strength};
        const Colour tint = plate_tint(paints(sun, sky));
        EXPECT_GT(tint[0], 0.3f) << strength;
        EXPECT_LT(tint[2], -0.9f) << strength;
        EXPECT_NEAR(std::exp(tint[0] - tint[1]), 2.0f, 0.3f) << strength;
    }
}

TEST(PlateTint, NightIsBlueBesideALamp) {
    const Colour tint = plate_tint(paints({0.06f, 0.3f, 0.9f}, {0.14f, 0.1f, 0.06f}));
    EXPECT_GT(tint[2], 0.3f);
    EXPECT_LT(tint[0], -0.3f);
}

TEST(PlateTint, SaysNothingOfBlackOrOfWhatIsNoNumber) {
    EXPECT_EQ(plate_tint(ImageF3(64, 64, 0.0f)), (Colour{0, 0, 0}));
    ImageF3 broken(64, 64, std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(plate_tint(broken), (Colour{0, 0, 0}));
    EXPECT_EQ(plate_tint(ImageF3()), (Colour{0, 0, 0}));
}

TEST(PlateTint, ColoursTheTextureAndKeepsItsLuminance) {
    const Colour tint{0.3f, 0.0f, -0.8f};
    const Matte all(64, 64, 255);
    ImageF3 texture(64, 64, 0.3f), half = texture, none = texture;
    apply_tint(texture, all, tint, 1);
    apply_tint(half, all, tint, 0.5f);
    apply_tint(none, all, tint, 0);
    const Colour got{texture.at(9, 9, 0), texture.at(9, 9, 1), texture.at(9, 9, 2)};
    EXPECT_NEAR(luminance(got), 0.3f, 1e-3f);
    EXPECT_NEAR(got[0] / got[2], std::exp(1.1f), 1e-3f);
    EXPECT_NEAR(half.at(9, 9, 0) / half.at(9, 9, 2), std::exp(0.55f), 1e-3f);
    EXPECT_EQ(none.at(9, 9, 0), 0.3f);
}

}  // namespace
}  // namespace weft
