// Plates whose pixels are not square: what a render lays on them, measured on its pixels.
#include <nlohmann/json.hpp>

#include <cmath>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

constexpr Size kWide{120, 160};  // 240 x 160 unsqueezed
constexpr int kCheck = 16;       // texels of a square

Words joined(Words a, const Words& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

class AnamorphicPlate : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        ImageF3 checks(2 * kCheck, 2 * kCheck);
        for (int y = 0; y < checks.height(); ++y)
            for (int x = 0; x < checks.width(); ++x)
                std::fill_n(checks.pixel(x, y), 3, is_white(x, y) ? 1.0f : 0.0f);
        put_picture("checks.png", checks);
        std::filesystem::create_directory(in("masks"));
        put_matte("masks/0001.png", Matte(kWide, 255));
        put_plate("plate.0001.exr", 2);
        put_plate("square.0001.exr", {});
    }
    static bool is_white(double u, double v) {
        const auto square = [](double at) { return static_cast<int>(std::floor(at / kCheck)); };
        return ((square(u) + square(v)) & 1) != 0;
    }
    void put_plate(const std::string& name, std::optional<double> aspect) const {
        ImageF3 grey(kWide, 0.2f);
        for (int y = 0; y < kWide.height; ++y)
            for (int x = 0; x < kWide.width; ++x)
                grey.pixel(x, y)[0] += 0.001f * static_cast<float>((7 * x + 13 * y) % 32);
        WriteOptions options;
        options.depth = PixelDepth::kHalf;
        options.pixel_aspect = aspect;
        ASSERT_TRUE(write_image(in(name), grey, {}, options));
    }
    Outcome lay(const std::string& plate, const Words& more = {}) const {
        Words words{"--plate",      plate,     "--plane", "checks.png", "-o",
                    "out/####.exr", "--light", "none",    "--progress", "none"};
        words.insert(words.end(), more.begin(), more.end());
        return run_replace(words);
    }
    ImageF3 laid(const std::string& plate, const Words& more = {}) const {
        const Outcome outcome = lay(plate, joined({"--overwrite"}, more));
        expect_success(outcome);
        return picture("out/0001.exr").rgb;
    }
};

bool white_at(const ImageF3& picture, Vec2 plate) {
    return picture.pixel(static_cast<int>(plate.x), static_cast<int>(plate.y))[1] > 0.5f;
}

// Pixels from one change of colour to the next along a row or column, the mean.
double run_along(const ImageF3& picture, Vec2 from, Vec2 step, int count) {
    int changes = 0, first = 0, last = 0;
    for (int k = 1; k < count; ++k) {
        const auto at = [&](int n) { return from + static_cast<float>(n) * step; };
        if (white_at(picture, at(k)) == white_at(picture, at(k - 1))) continue;
        last = k;
        if (++changes == 1) first = k;
    }
    return changes > 1 ? static_cast<double>(last - first) / (changes - 1) : 0;
}

TEST_F(AnamorphicPlate, ASquareOfTheTextureIsSquareWhenUnsqueezed) {
    const ImageF3 out = laid("plate.####.exr");
    EXPECT_NEAR(run_along(out, {0, 40}, {1, 0}, kWide.width), 8, 0.01);
    EXPECT_NEAR(run_along(out, {20, 0}, {0, 1}, kWide.height), 16, 0.01);
    const ImageF3 larger = laid("plate.####.exr", {"--scale", "1.5"});
    EXPECT_NEAR(run_along(larger, {0, 40}, {1, 0}, kWide.width), 12, 0.01);
    EXPECT_NEAR(run_along(larger, {20, 0}, {0, 1}, kWide.height), 24, 0.01);
    EXPECT_EQ(open_plate(in("out/0001.exr"), {}).value()->pixel_aspect(), 2);
}

TEST_F(AnamorphicPlate, RotationDoesNotShear) {
    for (const double degrees : {45.0, 30.0}) {
        const ImageF3 out =
            laid("plate.####.exr", {"--rotate", std::to_string(degrees), "--offset", "60,80"});
        const double angle = degrees * 3.14159265358979 / 180;
        int right = 0, all = 0;
        for (int v = -56; v <= 56; v += 16) {
            for (int u = -56; u <= 56; u += 16) {
                // The middle of a square, turned counter-clockwise on the picture unsqueezed.
                const double x = u * std::cos(angle) + v * std::sin(angle);
                const double y = v * std::cos(angle) - u * std::sin(angle);
                const Vec2 at(static_cast<float>(60 + x / 2), static_cast<float>(80 + y));
                ++all;
                right += white_at(out, at) == is_white(u, v);
            }
        }
        EXPECT_EQ(right, all) << degrees;
    }
}

TEST_F(AnamorphicPlate, TheProjectsPixelAspectReplacesTheFiles) {
    const ImageF3 told = laid("square.####.exr", {"--pixel-aspect", "2"});
    EXPECT_EQ(open_plate(in("out/0001.exr"), {}).value()->pixel_aspect(), 2);
    EXPECT_EQ(told, laid("plate.####.exr"));
    const ImageF3 square = laid("plate.####.exr", {"--pixel-aspect", "1"});
    EXPECT_EQ(open_plate(in("out/0001.exr"), {}).value()->pixel_aspect(), 1);
    EXPECT_EQ(square, laid("square.####.exr"));
    EXPECT_NEAR(run_along(square, {0, 40}, {1, 0}, kWide.width), 16, 0.01);
}

TEST_F(AnamorphicPlate, AnAspectOfOneChangesNoByte) {
    expect_success(lay("square.####.exr"));
    const std::string before = bytes("out/0001.exr");
    expect_success(lay("square.####.exr", {"--pixel-aspect", "1", "-o", "one/####.exr"}));
    const ImageF3 one = picture("one/0001.exr").rgb;
    EXPECT_EQ(one, picture("out/0001.exr").rgb);
}

TEST_F(AnamorphicPlate, AShapeAndAGrownTextureWorkToo) {
    put_picture("sample96.png", pattern_picture({96, 96}, 5));
    const Words form{"--form-shape", "plane:20,20,100,20,110,140,10,140"};
    expect_success(lay("plate.####.exr", form));
    expect_success(run(joined({"replace", "--plate", "plate.####.exr", "--matte", "masks/####.png",
                               "--texture", "sample96.png", "-o", "grown/####.exr", "--quality",
                               "draft", "--backend", "cpu", "--progress", "none"},
                              form)));
    const auto found_with = [&](const char* aspect) {
        return run(joined({"form", "--plate", "plate.####.exr", "--pixel-aspect", aspect, "--matte",
                           "masks/####.png", "--json"},
                          form));
    };
    const Outcome found = found_with("2"), square = found_with("1");
    expect_success(found);
    expect_success(square);
    const auto tilt = [](const Outcome& outcome) {
        return Json::parse(outcome.out)["forms"][0]["tilt_deg"].get<double>();
    };
    EXPECT_GT(std::abs(tilt(found) - tilt(square)), 1) << "another camera";
}

TEST_F(AnamorphicPlate, WrongAspectsAreRefused) {
    for (const char* wrong : {"0", "-2", "nan", "inf", "100", "0.01", "wide"}) {
        const Outcome outcome = lay("plate.####.exr", {"--pixel-aspect", wrong});
        expect_failure(outcome, 2, {"--pixel-aspect"});
        EXPECT_TRUE(names("out").empty());
    }
}

TEST_F(AnamorphicPlate, AProjectKeepsItAndInfoSaysIt) {
    expect_success(run({"new", "shot.weft", "--plate", "square.####.exr", "--pixel-aspect", "2"}));
    EXPECT_EQ(Json::parse(bytes("shot.weft"))["plate"]["pixel_aspect"], 2.0);
    const Outcome info = run({"info", "shot.weft", "--json"});
    expect_success(info);
    EXPECT_EQ(Json::parse(info.out)["plate"]["pixel_aspect"], 2.0);
    EXPECT_THAT(run({"info", "shot.weft"}).out, HasSubstr("pixel aspect 2"));
}

}  // namespace
}  // namespace weft::test
