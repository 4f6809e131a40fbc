#include "engine/composite/line_layer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace weft {
namespace {

constexpr Size kSize{96, 72};

double coverage(double distance, double width) {
    return std::min(1.0, std::max(0.0, 0.5 + width / 2 - std::abs(distance)));
}

// An oblique stroke of 3 px on a fill of 170, and a dark fill of 40 beyond x = 70.
double stroke_at(int x, int y) {
    return coverage((x + 0.5 - 30 - 0.4 * (y + 0.5)) / std::hypot(1, 0.4), 3);
}

ImageU8x3 drawing() {
    ImageU8x3 out(kSize);
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const double l = stroke_at(x, y), fill = x >= 70 ? 40 : 170;
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = static_cast<std::uint8_t>((1 - l) * fill + l * 30 + 0.5);
        }
    }
    return out;
}

TEST(ExtractInk, FindsAStrokeWithItsSoftEdges) {
    const Matte ink = extract_ink(drawing(), Matte(kSize, 255));
    double error = 0;
    int count = 0;
    for (int y = 8; y < 64; ++y) {
        for (int x = 0; x < 60; ++x) {
            error += std::abs(ink.at(x, y) / 255.0 - stroke_at(x, y));
            count += stroke_at(x, y) > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(count, 150);
    EXPECT_LT(error / count, 0.12);
}

TEST(ExtractInk, TakesNoDarkFillForInk) {
    const Matte ink = extract_ink(drawing(), Matte(kSize, 255));
    for (int y = 8; y < 30; ++y)
        for (int x = 74; x < kSize.width; ++x)
            ASSERT_EQ(ink.at(x, y), 0) << x << "," << y;
}

TEST(ExtractInk, FindsNothingInAFlatOrShadedFill) {
    ImageU8x3 shaded(kSize);
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            for (int c = 0; c < 3; ++c)
                shaded.at(x, y, c) = static_cast<std::uint8_t>(90 + x);
    EXPECT_EQ(extract_ink(shaded, Matte(kSize, 255)), Matte(kSize));
}

TEST(ExtractInk, StaysAtTheRegion) {
    Matte matte(kSize);
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < kSize.width; ++x)
            matte.at(x, y) = 255;
    const Matte ink = extract_ink(drawing(), matte);
    EXPECT_GT(ink.at(38, 20), 200);
    for (int y = 42; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            ASSERT_EQ(ink.at(x, y), 0);
}

TEST(LayLines, PutsTheInksOwnColourOverTheTexture) {
    // Brown ink on a green fill; half covered pixels show a mixture, whose fill must not come
    // along.
    ImageF3 plate(kSize), surface(kSize, 0.8f);
    Matte lines(kSize);
    const float ink[3] = {0.10f, 0.06f, 0.03f}, fill[3] = {0.1f, 0.7f, 0.2f};
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const auto l = static_cast<float>(stroke_at(x, y));
            lines.at(x, y) = static_cast<std::uint8_t>(255 * l + 0.5f);
            for (int c = 0; c < 3; ++c)
                plate.at(x, y, c) = l * ink[c] + (1 - l) * fill[c];
        }
    }
    lay_lines(surface, plate, lines);
    for (int y = 10; y < 62; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const float l = static_cast<float>(lines.at(x, y)) / 255.0f;
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(surface.at(x, y, c), (1 - l) * 0.8f + l * ink[c], 0.05f)
                    << x << "," << y;
        }
    }
}

TEST(LayLines, LeavesTheSurfaceAloneWithoutInkOrPlate) {
    ImageF3 plate(kSize, 0.2f), surface(kSize, 0.6f);
    lay_lines(surface, plate, Matte(kSize));
    EXPECT_EQ(surface, ImageF3(kSize, 0.6f));
    plate.at(5, 5, 1) = std::numeric_limits<float>::quiet_NaN();
    lay_lines(surface, plate, Matte(kSize, 255));
    EXPECT_EQ(surface.at(5, 5, 0), 0.6f);
    EXPECT_NEAR(surface.at(6, 5, 0), 0.2f, 1e-6f);
}

TEST(LayLines, TakesThePlateForInkWhereNoStrokeHasACore) {
    ImageF3 plate(kSize, 0.2f), surface(kSize, 0.6f);
    lay_lines(surface, plate, Matte(kSize, 128));
    EXPECT_NEAR(surface.at(40, 30, 0), 0.6f - 0.4f * 128 / 255, 1e-5f);
}

}  // namespace
}  // namespace weft
