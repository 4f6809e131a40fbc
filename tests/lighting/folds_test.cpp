// What of a cloth's lightness is folds, and what is printed on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/lighting/clip_reflectance.h"
#include "engine/lighting/shading.h"
#include "engine/lighting/surface_pattern.h"
#include "tests/lighting/lighting_scene.h"

namespace weft {
namespace {

using scene::cloth;
using scene::Colour;
using scene::scaled;

const Recti kCloth{20, 16, 300, 224};
constexpr int kEdge = 8;  // pixels beside the outline that are not judged

// The height of a fold, -1 to 1: oblique, bent, and here and there fainter.
float fold(int px, int py) {
    const auto x = static_cast<float>(px), y = static_cast<float>(py);
    const float bent = x + 0.5f * y + 7 * std::sin(y / 23);
    const float strength = 0.6f + 0.4f * std::sin(x / 31) * std::cos(y / 37);
    return strength * std::sin(bent * 0.14f);
}

float fold_light(int x, int y) {
    return std::exp(0.18f * fold(x, y));
}

bool on_line(int y) {
    return y % 34 < 4;
}

Shading light_on(const ImageF3& plate) {
    return estimate_shading(plate, scene::box_matte(kCloth), {});
}

// Of ln light that was found with a true one, well inside the cloth.
template <class Truth>
double correlation_with(const Shading& s, const Truth& truth) {
    double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    const int d = s.downscale;
    for (int y = (kCloth.y0 + kEdge) / d; y < (kCloth.y1 - kEdge) / d; ++y) {
        for (int x = (kCloth.x0 + kEdge) / d; x < (kCloth.x1 - kEdge) / d; ++x) {
            const double u = std::log(s.value.at(x, y)), v = truth(d * x + d / 2, d * y + d / 2);
            n += 1, a += u, b += v, aa += u * u, bb += v * v, ab += u * v;
        }
    }
    return (ab - a * b / n) / std::sqrt((aa - a * a / n) * (bb - b * b / n));
}

double as_folds(const Shading& s) {
    return correlation_with(s, [](int x, int y) { return fold(x, y); });
}

TEST(Folds, AreLightBetweenPrintedLinesWhichAreNone) {
    const Shading s = light_on(cloth([](int x, int y) {
        const Colour paint = on_line(y) ? Colour{0.05f, 0.05f, 0.05f} : Colour{0.6f, 0.58f, 0.54f};
        return scaled(paint, fold_light(x, y));
    }));
    EXPECT_GT(as_folds(s), 0.9);
    EXPECT_LT(std::abs(correlation_with(s, [](int, int y) { return on_line(y) ? 1.0 : 0.0; })),
              0.1);
}

// Motion that misses a few pixels, so that the clip knows the lines faintly.
TEST(Folds, LinesAreNoLightOfAClipWhoseMotionIsOff) {
    const ShadingOptions options;
    const Matte matte = scene::box_matte(kCloth);
    ReflectanceGatherer gatherer(options);
    std::optional<SurfaceSample> last;
    for (const int off : {-3, -2, -1, 0, 1, 2, 3, 0}) {
        const ImageF3 plate = cloth([off](int x, int y) {
            const float ink = on_line(y + off) ? 0.12f : 0.6f;
            return scaled({ink, ink, ink}, fold_light(x, y));
        });
        last = light_sample(plate, matte, options);
        gatherer.add(*last, ImageF2(last->box.size()));
    }
    const Shading s = shading_with(*last, gatherer.finish(), ImageF2(last->box.size()), options);
    EXPECT_GT(as_folds(s), 0.9);
    EXPECT_LT(std::abs(correlation_with(s, [](int, int y) { return on_line(y) ? 1.0 : 0.0; })),
              0.15);
}

// Wrinkles a few pixels wide and some percent deep.
float wrinkle(int x, int y) {
    return std::sin(0.5f * static_cast<float>(x) + 0.2f * static_cast<float>(y));
}

TEST(Folds, FaintWrinklesThatStayAreKeptOfAClip) {
    const ShadingOptions options;
    const Matte matte = scene::box_matte(kCloth);
    const SurfaceSample sample = light_sample(cloth([](int x, int y) {
                                                  const float light =
                                                      0.5f * std::exp(0.05f * wrinkle(x, y));
                                                  return Colour{light, light, light};
                                              }),
                                              matte, options);
    ReflectanceGatherer gatherer(options);
    for (int k = 0; k < 5; ++k)
        gatherer.add(sample, ImageF2(sample.box.size()));
    const Shading s = shading_with(sample, gatherer.finish(), ImageF2(sample.box.size()), options);
    EXPECT_GT(correlation_with(s, wrinkle), 0.9);
    float least = 1e9f, most = 0;
    for (int x = 40; x < 80; ++x)
        least = std::min(least, s.value.at(x, 60)), most = std::max(most, s.value.at(x, 60));
    EXPECT_GT(most / least, 1.04f) << "they are 1.1";
}

// Brown clouds on cream: as soft as folds and of one hue, but without a direction.
TEST(Folds, SoftPaintIsNone) {
    const auto cloud = [](int px, int py) {
        const auto x = static_cast<float>(px), y = static_cast<float>(py);
        return 0.25f * (std::sin(x / 9) + std::sin(y / 9) + std::sin((x + y) / 12) +
                        std::sin((x - y) / 12));
    };
    const Shading s = light_on(cloth([&](int x, int y) {
        const float share = 0.5f + 0.5f * cloud(x, y);
        return Colour{0.16f + 0.44f * share, 0.09f + 0.41f * share, 0.05f + 0.33f * share};
    }));
    double n = 0, sum = 0, squares = 0;
    for (int y = (kCloth.y0 + kEdge) / 2; y < (kCloth.y1 - kEdge) / 2; ++y) {
        for (int x = (kCloth.x0 + kEdge) / 2; x < (kCloth.x1 - kEdge) / 2; ++x) {
            const double v = std::log(s.value.at(x, y));
            n += 1, sum += v, squares += v * v;
        }
    }
    EXPECT_LT(std::sqrt(squares / n - sum / n * sum / n), 0.1) << "the paint's is 0.35";
}

TEST(Folds, AreLightWhereTheirColourShifts) {
    const Shading s = light_on(cloth([](int x, int y) {
        const float lilac = 0.12f * std::pow(0.5f + 0.5f * fold(x, y), 2.0f);
        return Colour{0.09f + 0.6f * lilac, 0.02f + 0.48f * lilac, 0.14f + 0.7f * lilac};
    }));
    EXPECT_GT(as_folds(s), 0.9);
}

TEST(Folds, StripesOfTwoColoursAreNone) {
    const auto red = [](int x) { return x / 24 % 2 == 0; };
    const Shading s = light_on(cloth([&](int x, int y) {
        const Colour paint = red(x) ? Colour{0.5f, 0.1f, 0.08f} : Colour{0.6f, 0.55f, 0.4f};
        return scaled(paint, fold_light(x, y));
    }));
    EXPECT_LT(std::abs(correlation_with(s, [&](int x, int) { return red(x) ? 1.0 : 0.0; })), 0.2);
}

// Colours of a mosaic, cells of several sizes.
float cell(int x, int y, int size, unsigned channel) {
    const auto key = static_cast<unsigned>(x / size * 131 + y / size * 71 + 17 * size) + channel;
    return static_cast<float>(key * 2654435761u >> 16 & 255u) / 255.0f;
}

TEST(Folds, FineMosaicsOfManyColoursAreNone) {
    const auto tones = [](int x, int y) {
        const float coarse = cell(x, y, 11, 0), fine = cell(x, y, 3, 0);
        return Colour{0.03f + 0.2f * coarse + 0.1f * fine, 0.08f + 0.12f * coarse + 0.1f * fine,
                      0.06f + 0.1f * fine + 0.12f * cell(x, y, 7, 9)};
    };
    ShadingOptions options;
    options.pattern_px = 2.6f;  // of a plate that is 160 px wide
    const Shading s = estimate_shading(cloth(tones), scene::box_matte(kCloth), options);
    float least = 1e9f, most = 0;
    for (int y = (kCloth.y0 + kEdge) / 2; y < (kCloth.y1 - kEdge) / 2; ++y) {
        for (int x = (kCloth.x0 + kEdge) / 2; x < (kCloth.x1 - kEdge) / 2; ++x)
            least = std::min(least, s.value.at(x, y)), most = std::max(most, s.value.at(x, y));
    }
    EXPECT_LT(most / least, 1.6f) << "its light is even";
}

// ln luma of 0, but −1.4 where `dark` holds; whether surface_pattern() takes any of it for marks.
template <class Dark>
bool has_marks(const Dark& dark) {
    constexpr Size kSmall{140, 104};
    ImageF1 luma(kSmall);
    const ImageF1 weight(kSmall, 1.0f);
    for (int y = 0; y < kSmall.height; ++y)
        for (int x = 0; x < kSmall.width; ++x)
            luma.row(y)[x] = dark(x, y) ? -1.4f : 0.0f;
    const SurfacePattern found = surface_pattern(luma, luma, weight, 7);
    EXPECT_LT(found.presence, 0.1f);
    return std::any_of(found.ground.data(),
                       found.ground.data() + found.ground.width() * found.ground.height(),
                       [](float w) { return w == 0; });
}

TEST(SurfacePattern, MarksAreAllOverTheSurface) {
    EXPECT_TRUE(has_marks([](int, int y) { return y % 17 < 2; })) << "lines";
    EXPECT_TRUE(has_marks([](int x, int y) { return y % 15 < 4 && x % 15 < 4; })) << "dots";
    EXPECT_FALSE(has_marks([](int x, int y) { return x > 30 && x < 34 && y < 80; })) << "a crease";
    EXPECT_FALSE(has_marks([](int x, int y) { return x > 90 && y > 80; })) << "a shadow";
    EXPECT_FALSE(has_marks([](int, int) { return false; }));
}

// Creases of one depth all over plain cloth, and never darker than half of what is around them.
TEST(SurfacePattern, CreasesAreNoMarks) {
    constexpr Size kSmall{140, 104};
    ImageF1 luma(kSmall);
    const ImageF1 weight(kSmall, 1.0f);
    for (int y = 0; y < kSmall.height; ++y) {
        for (int x = 0; x < kSmall.width; ++x) {
            const float depth = 0.5f + 0.15f * std::sin(static_cast<float>(x) * 0.2f);
            const auto beside = static_cast<float>(std::abs(y % 17 - 8));
            luma.row(y)[x] = -depth * std::max(0.0f, 1 - beside / 3);
        }
    }
    const SurfacePattern found = surface_pattern(luma, luma, weight, 7);
    EXPECT_FALSE(found.marks.dark);
    EXPECT_FALSE(found.marks.light);
}

TEST(SurfacePattern, MarksGoOnWhereTheyAreFaintAndThin) {
    constexpr Size kSmall{140, 104};
    ImageF1 luma(kSmall);
    const ImageF1 weight(kSmall, 1.0f);
    for (int y = 0; y < kSmall.height; ++y) {
        for (int x = 0; x < kSmall.width; ++x) {
            if (y % 17 == 8) luma.row(y)[x] = x < 70 ? -1.4f : -0.25f;
            if (y % 17 > 8 && y % 17 < 15 && x >= 100) luma.row(y)[x] = -0.25f;  // a fold
        }
    }
    const SurfacePattern found = surface_pattern(luma, luma, weight, 7);
    EXPECT_TRUE(found.marks.dark);
    EXPECT_EQ(found.ground.at(90, 42), 0) << "the line where it is faint";
    EXPECT_GT(found.ground.at(120, 46), 0) << "the fold beside it";
}

TEST(SurfacePattern, ShadeRunsOnAcrossAMark) {
    constexpr Size kSmall{40, 20};
    ImageF1 light(kSmall), ground(kSmall, 1.0f);
    const ImageF1 weight(kSmall, 1.0f);
    const auto shade = [](int x) { return 0.03f * static_cast<float>(x); };
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 40; ++x) {
            const bool marked = x >= 18 && x < 24;
            light.row(y)[x] = marked ? shade(18) : shade(x);
            ground.row(y)[x] = marked ? 0.0f : 1.0f;
        }
    }
    bridge_marks(light, weight, ground);
    for (int x = 0; x < 40; ++x)
        EXPECT_NEAR(light.at(x, 10), shade(x), 0.01f) << x;
}

}  // namespace
}  // namespace weft
