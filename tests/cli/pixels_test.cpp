// File contents: the plate outside the matte bit for bit, NaN, values above 1.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <ostream>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Format {
    const char* extension;
    PixelDepth depth;
};

// For the name of the test.
void PrintTo(const Format& format, std::ostream* out) {
    *out << format.extension << " depth " << static_cast<int>(format.depth);
}

// Values that use the full depth, so that losing a few bits is detected.
void refine(ImageF3& plate, PixelDepth depth) {
    for (std::size_t i = 0; i < plate.size_bytes() / sizeof(float); ++i) {
        float& v = plate.data()[i];
        const auto place = static_cast<float>(i % 251);
        if (depth == PixelDepth::kU16) v = std::round(v * 65535.0f - place) / 65535.0f;
        if (depth == PixelDepth::kFloat) v = v * 4.0f + place * 1e-6f - 0.3f;
        if (depth == PixelDepth::kHalf) v = v * 4.0f;
    }
}

std::int64_t differing(const ImageF3& a, const ImageF3& b, const Matte& matte, bool inside) {
    std::int64_t count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            count += (matte.at(x, y) > 0) == inside &&
                     std::memcmp(a.pixel(x, y), b.pixel(x, y), 3 * sizeof(float)) != 0;
    return count;
}

class OutsideTheMatte : public CliTest, public ::testing::WithParamInterface<Format> {};

TEST_P(OutsideTheMatte, ThePlateIsUnchanged) {
    const Format format = GetParam();
    const std::string extension = format.extension;
    make_shot(3, 1, extension, format.depth,
              [&](int, ImageF3& plate) { refine(plate, format.depth); });
    expect_success(
        run_replace({"--plate", "frames/####" + extension, "-o", "out/####" + extension}));
    for (int step = 0; step < 3; ++step) {
        const std::string name = "000" + std::to_string(step + 1) + extension;
        const PlateFrame plate = picture("frames/" + name), result = picture("out/" + name);
        EXPECT_EQ(result.depth, format.depth);
        EXPECT_EQ(differing(plate.rgb, result.rgb, card_matte(step), false), 0) << name;
        EXPECT_GT(differing(plate.rgb, result.rgb, card_matte(step), true), 4000) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, OutsideTheMatte,
                         ::testing::Values(Format{".png", PixelDepth::kU8},
                                           Format{".png", PixelDepth::kU16},
                                           Format{".tif", PixelDepth::kU16},
                                           Format{".exr", PixelDepth::kHalf},
                                           Format{".exr", PixelDepth::kFloat}));

using IdentityMap = CliTest;

// An identity map gives the mean of the texture over each pixel (decision 5): the integrals of the
// cubic over whole texels.
TEST_F(IdentityMap, GivesTheTextureAsSoftAsItsMeanOverAPixel) {
    make_shot(1);
    const Size size = Card::kPlate;
    ImageF3 plane(size), map(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            std::fill_n(plane.pixel(x, y), 3, (120 + 16 * ((x * 7 + y * 13 + x * y) % 3)) / 255.0f);
            map.at(x, y, 0) = (static_cast<float>(x) + 0.5f) / static_cast<float>(size.width);
            map.at(x, y, 1) = 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height);
        }
    }
    put_picture("plane.png", plane);
    put_picture("uv.exr", map, PixelDepth::kFloat);
    expect_success(
        run_replace({"--plane", "plane.png", "--uv", "uv.exr", "--light", "none", "--grain", "0",
                     "--defocus", "0", "--match-plate", "0", "--quality", "final"}));
    constexpr float kMean[] = {-0.0130f, 0.0938f, 0.8385f, 0.0938f, -0.0130f};
    const ImageF3 result = picture("out/0001.png").rgb;
    const Matte matte = card_matte(0);
    float from_mean = 0, from_texels = 0;
    int count = 0;
    for (int y = 2; y + 2 < size.height; ++y) {
        for (int x = 2; x + 2 < size.width; ++x) {
            if (matte.at(x, y) != 255) continue;
            float mean = 0;
            for (int v = -2; v <= 2; ++v)
                for (int u = -2; u <= 2; ++u)
                    mean += kMean[u + 2] * kMean[v + 2] * plane.at(x + u, y + v, 0);
            from_mean += std::abs(result.at(x, y, 0) - mean) * 255;
            from_texels += std::abs(result.at(x, y, 0) - plane.at(x, y, 0)) * 255;
            ++count;
        }
    }
    ASSERT_GT(count, 1000);
    EXPECT_LT(from_mean / static_cast<float>(count), 1.6f);
    EXPECT_GT(from_texels / static_cast<float>(count), 2.4f);
}

class NonFinite : public CliTest {
  protected:
    static constexpr float kInfinity = std::numeric_limits<float>::infinity();
    void make_damaged_shot() {
        make_shot(3, 1, ".exr", PixelDepth::kFloat, [](int frame, ImageF3& plate) {
            if (frame != 2) return;
            plate.at(5, 6, 1) = std::bit_cast<float>(0x7fc12345u);  // a NaN with a payload
            plate.at(150, 100, 0) = -kInfinity;
            for (int x = 60; x < 64; ++x)
                plate.at(x, 50, 2) = kInfinity;
            plate.at(70, 60, 0) = std::nanf("");
        });
    }
    Outcome render(const Words& more = {}) {
        Words words{"--plate", "frames/####.exr", "-o", "out/####.exr"};
        words.insert(words.end(), more.begin(), more.end());
        return run_replace(words);
    }
};

TEST_F(NonFinite, WarnsWithFrameAndCountFillsInsideAndPassesThroughOutside) {
    make_damaged_shot();
    const Outcome outcome = render();
    expect_success(outcome);
    expect_one_line(outcome.err,
                    {"warning", "NaN", "frame 2 (7 pixels)", "5 in a matte", "2 outside"});
    const PlateFrame plate = picture("frames/0002.exr"), result = picture("out/0002.exr");
    EXPECT_EQ(differing(plate.rgb, result.rgb, card_matte(1), false), 0);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(result.rgb.at(5, 6, 1)), 0x7fc12345u);
    EXPECT_EQ(result.nonfinite, 2);
    // Nothing of it reaches the neighbours or the other frames.
    EXPECT_EQ(picture("out/0001.exr").nonfinite + picture("out/0003.exr").nonfinite, 0);
    for (int x = 58; x < 66; ++x)
        EXPECT_LT(result.rgb.at(x, 50, 2), 2.0f) << x;
}

TEST_F(NonFinite, OutsideOfAnyMatteIsReportedToo) {
    make_shot(2, 1, ".exr", PixelDepth::kHalf, [](int frame, ImageF3& plate) {
        if (frame == 1) plate.at(2, 3, 0) = std::nanf("");
    });
    const Outcome outcome = render();
    expect_success(outcome);
    expect_one_line(outcome.err, {"warning", "frame 1 (1 pixel)", "0 in a matte", "1 outside"});
}

TEST_F(NonFinite, DoesNotDisturbTheRestOfTheSurface) {
    make_damaged_shot();
    render();
    const PlateFrame damaged = picture("out/0002.exr");
    std::filesystem::remove_all(folder_ / "frames");
    make_shot(3, 1, ".exr", PixelDepth::kFloat);
    expect_success(render({"--overwrite"}));
    const PlateFrame sound = picture("out/0002.exr");
    // Motion and light are estimates: a few invalid pixels may change them slightly.
    double worst = 0;
    for (int y = 30; y < 80; ++y)
        for (int x = 36; x < 108; ++x)
            for (int c = 0; c < 3; ++c)
                worst = std::max<double>(worst,
                                         std::abs(damaged.rgb.at(x, y, c) - sound.rgb.at(x, y, c)));
    EXPECT_LT(worst, 0.15);
}

TEST_F(CliTest, SceneLinearValuesAboveOneSurvive) {
    make_shot(2, 1, ".exr", PixelDepth::kFloat, [](int, ImageF3& plate) {
        for (std::size_t i = 0; i < plate.size_bytes() / sizeof(float); ++i)
            plate.data()[i] *= 6;
    });
    ImageF3 bright = pattern_picture({64, 64}, 3);
    for (std::size_t i = 0; i < bright.size_bytes() / sizeof(float); ++i)
        bright.data()[i] *= 5;
    put_picture("bright.exr", bright, PixelDepth::kFloat);
    const Outcome outcome = run_replace({"--plate", "frames/####.exr", "-o", "out/####.exr",
                                         "--plane", "bright.exr", "--light", "none"});
    expect_success(outcome);
    EXPECT_THAT(outcome.err, IsEmpty());  // nothing was rolled off
    const PlateFrame result = picture("out/0001.exr");
    const Matte matte = card_matte(0);
    float outside = 0, inside = 0;
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x) {
            float& most = matte.at(x, y) > 0 ? inside : outside;
            most = std::max(most, result.rgb.at(x, y, 0));
        }
    EXPECT_GT(outside, 4.0f);
    EXPECT_GT(inside, 3.0f);
}

// A sunlit patch on the card, a hundred times brighter than the rest.
TEST_F(CliTest, SceneLinearLightUpTo100IsNeitherClippedNorTinted) {
    constexpr int kSunFrom = 44;  // px from the card's left side
    make_shot(3, 1, ".exr", PixelDepth::kHalf, [](int frame, ImageF3& plate) {
        const int left = Card::corner(frame - 1).x + kSunFrom;
        for (int y = 0; y < plate.height(); ++y) {
            for (int x = 0; x < plate.width(); ++x) {
                for (int c = 0; c < 3; ++c)
                    plate.at(x, y, c) = plate.at(x, y, c) * (x >= left ? 100.0f : 0.5f);
            }
        }
    });
    put_picture(
        "ochre.exr",
        [] {
            ImageF3 plane(64, 64);
            for (std::size_t i = 0; i < 64 * 64; ++i)
                plane.data()[3 * i] = 0.5f, plane.data()[3 * i + 1] = 0.25f,
                                 plane.data()[3 * i + 2] = 0.125f;
            return plane;
        }(),
        PixelDepth::kFloat);
    for (const char* quality : {"draft", "final"}) {
        expect_success(
            run_replace({"--plate", "frames/####.exr", "-o", "out/####.exr", "--plane", "ochre.exr",
                         "--quality", quality, "--light-tint", "0", "--overwrite"}));
        for (int frame = 1; frame <= 3; ++frame) {
            const std::string name = "000" + std::to_string(frame) + ".exr";
            const PlateFrame plate = picture("frames/" + name), result = picture("out/" + name);
            EXPECT_EQ(differing(plate.rgb, result.rgb, card_matte(frame - 1), false), 0) << name;
            const Vec2i corner = Card::corner(frame - 1);
            const auto mean = [&](int from, int to) {
                double sum = 0;
                for (int y = corner.y + 6; y < corner.y + Card::kHeight - 6; ++y) {
                    for (int x = corner.x + from; x < corner.x + to; ++x)
                        sum += result.rgb.at(x, y, 0);
                }
                return sum / (to - from);
            };
            // The plate's step is 200.
            const double step = mean(kSunFrom + 8, Card::kWidth - 6) / mean(6, kSunFrom - 8);
            EXPECT_GT(step, 100) << quality << name;
            EXPECT_LT(step, 400) << quality << name;
            const float* shade = result.rgb.pixel(corner.x + kSunFrom - 20, corner.y + 30);
            const float* sun = result.rgb.pixel(corner.x + kSunFrom + 18, corner.y + 30);
            for (const float* p : {shade, sun}) {
                EXPECT_NEAR(p[1] / p[0], 0.5, 0.002) << quality << name;
                EXPECT_NEAR(p[2] / p[0], 0.25, 0.002) << quality << name;
            }
        }
    }
}

}  // namespace
}  // namespace weft::test
