// A checked shirt: its checks are paint, its folds are light.
#include "engine/lighting/surface_print.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "engine/lighting/shading.h"
#include "tests/lighting/lighting_scene.h"

namespace weft {
namespace {

using scene::Colour;

const Recti kShirt{20, 16, 300, 224};
constexpr int kInside = 10;  // pixels beside the outline that are not judged

// Wide, oblique folds, from half to twice the light.
float fold_of(int px, int py) {
    const auto x = static_cast<float>(px), y = static_cast<float>(py);
    return 0.6f * std::sin(0.06f * (x + 0.6f * y + 9 * std::sin(y / 27)));
}

Colour woven(const Colour& warp, const Colour& weft) {
    Colour out{};
    for (std::size_t c = 0; c < out.size(); ++c)
        out[c] = 0.5f * (warp[c] + weft[c]);
    return out;
}

// Threads of teal, white, black and red over a period of 54 px: wider than what a blur of the
// pattern's size averages out.
Colour thread(int at) {
    const int k = at % 54;
    if (k < 18) return {0.03f, 0.32f, 0.22f};
    if (k < 26) return {0.75f, 0.72f, 0.70f};
    if (k < 38) return {0.02f, 0.02f, 0.025f};
    if (k < 47) return {0.55f, 0.10f, 0.09f};
    return {0.70f, 0.62f, 0.66f};
}

Colour check(int x, int y) {
    return woven(thread(x), thread(y + 7));
}

float luma_of(const Colour& c) {
    return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
}

template <class Paint>
ImageF3 shirt(const Paint& paint, float exposure = 1) {
    return scene::cloth([&](int x, int y) {
        return scene::scaled(paint(x, y), exposure * std::exp(fold_of(x, y)));
    });
}

// The share of what was found for ln light that goes with the folds, and with the checks: slopes of
// a regression on both.
std::pair<double, double> folds_and_checks(const Shading& s) {
    double n = 0;
    std::array<double, 3> mean{};
    std::array<std::array<double, 3>, 3> m{};
    const int d = s.downscale;
    for (int y = (kShirt.y0 + kInside) / d; y < (kShirt.y1 - kInside) / d; ++y) {
        for (int x = (kShirt.x0 + kInside) / d; x < (kShirt.x1 - kInside) / d; ++x) {
            const int px = d * x + d / 2, py = d * y + d / 2;
            const std::array<double, 3> v{fold_of(px, py), std::log(luma_of(check(px, py)) + 0.01),
                                          std::log(s.value.at(x, y))};
            n += 1;
            for (std::size_t i = 0; i < 3; ++i) {
                mean[i] += v[i];
                for (std::size_t j = 0; j < 3; ++j)
                    m[i][j] += v[i] * v[j];
            }
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            m[i][j] = m[i][j] / n - mean[i] / n * mean[j] / n;
    }
    const double det = m[0][0] * m[1][1] - m[0][1] * m[0][1];
    return {(m[0][2] * m[1][1] - m[1][2] * m[0][1]) / det,
            (m[1][2] * m[0][0] - m[0][2] * m[0][1]) / det};
}

const Matte& matte() {
    static const Matte whole = scene::box_matte(kShirt);
    return whole;
}

TEST(SurfacePrint, ChecksArePaintAndFoldsAreLight) {
    const ImageF3 plate = shirt(check);
    const auto [folds, checks] = folds_and_checks(estimate_shading(plate, matte(), {}));
    EXPECT_GT(folds, 0.85);
    EXPECT_LT(std::abs(checks), 0.04);
    ShadingOptions without;
    without.print = SurfacePrint{};
    const auto blotched = folds_and_checks(estimate_shading(plate, matte(), without));
    EXPECT_GT(blotched.second, 0.1) << "a colour's relation to lightness leaves them";
}

// Found once for the shot, it holds in a frame that is exposed otherwise.
TEST(SurfacePrint, HoldsThroughAFlash) {
    const SurfacePrint print = light_sample(shirt(check), matte(), {}).print;
    ASSERT_EQ(print.confidence, 1.0f);
    ShadingOptions options;
    options.print = print;
    const Shading dim = estimate_shading(shirt(check), matte(), options);
    const Shading bright = estimate_shading(shirt(check, 3), matte(), options);
    const auto [folds, checks] = folds_and_checks(bright);
    EXPECT_GT(folds, 0.85);
    EXPECT_LT(std::abs(checks), 0.04);
    EXPECT_NEAR(median_shading(bright, matte()) / median_shading(dim, matte()), 3, 0.1);
}

float confidence_of(const ImageF3& plate, const Matte& visible) {
    return light_sample(plate, visible, {}).print.confidence;
}

TEST(SurfacePrint, ClothOfOnePaintHasNone) {
    EXPECT_EQ(confidence_of(shirt([](int, int) { return Colour{0.5f, 0.1f, 0.08f}; }), matte()), 0);
}

// Hair is redder where it is darker, strand by strand, all over.
TEST(SurfacePrint, AColourThatGoesWithLightnessIsNone) {
    EXPECT_EQ(confidence_of(shirt([](int x, int y) {
                                const float strand =
                                    0.5f + 0.5f * std::sin(0.9f * static_cast<float>(x) +
                                                           0.1f * static_cast<float>(y));
                                return Colour{0.02f + 0.6f * strand, 0.3f * strand * strand,
                                              0.1f * strand * strand};
                            }),
                            matte()),
              0);
}

// A rider in a black coat on a brown horse: several paints, each in one place.
TEST(SurfacePrint, AFigureOfSeveralThingsHasNone) {
    EXPECT_EQ(
        confidence_of(shirt([](int x, int y) {
                          if (y < 90) return Colour{0.02f, 0.02f, 0.03f};
                          if (x < 120) return Colour{0.6f, 0.58f, 0.55f};
                          return y < 150 ? Colour{0.25f, 0.1f, 0.04f} : Colour{0.05f, 0.2f, 0.4f};
                      }),
                      matte()),
        0);
}

TEST(SurfacePrint, APatchOfClothTooSmallToTellHasNone) {
    EXPECT_EQ(confidence_of(shirt(check), scene::box_matte({100, 80, 180, 150})), 0);
}

TEST(SurfacePrint, ABlackFrameAndAnEmptyMatteAreNoPrint) {
    EXPECT_EQ(confidence_of(ImageF3(scene::kSize), matte()), 0);
    EXPECT_EQ(confidence_of(shirt(check), Matte(scene::kSize)), 0);
    ShadingOptions options;
    options.print = light_sample(shirt(check), matte(), {}).print;
    for (const float v : {0.0f, 40.0f}) {
        const Shading s = estimate_shading(ImageF3(scene::kSize, v), matte(), options);
        const float least = s.value.at(80, 60), most = s.value.at(100, 80);
        EXPECT_TRUE(std::isfinite(least) && std::isfinite(most));
        EXPECT_NEAR(least / most, 1, 0.01) << "even light of " << v;
    }
}

}  // namespace
}  // namespace weft
