// OpenColorIO spaces, with small configs written here.

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/color/color_files.h"
#include "engine/color/color_space.h"
#include "engine/color/screen_view.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kHead = R"(ocio_profile_version: 2
search_path: luts
strictparsing: true
roles:
  default: raw
  scene_linear: %SCENE%
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  wall:
    - !<View> {name: Raw, colorspace: raw}
    - !<View> {name: Bright, colorspace: doubled}
  screen:
    - !<View> {name: Raw, colorspace: raw}
active_displays: [screen, wall]
active_views: []
colorspaces:
  - !<ColorSpace>
    name: raw
    isdata: true
)";

constexpr const char* kLinear = R"(  - !<ColorSpace>
    name: Linear Rec.709 (sRGB)
    aliases: [lin_rec709_srgb]
    isdata: false
)";
// Twice as bright, and linear with red and blue exchanged: easy to tell from anything else.
constexpr const char* kOthers = R"(  - !<ColorSpace>
    name: doubled
    aliases: [twice, double_gain]
    from_scene_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: swapped
    from_scene_reference: !<MatrixTransform> {matrix: [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]}
)";
constexpr const char* kTexture = R"(  - !<ColorSpace>
    name: sRGB - Texture
    from_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}
)";

class Ocio : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (std::filesystem::temp_directory_path() / "weft_ocio_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override {
        unsetenv("OCIO");
        std::filesystem::remove_all(folder_);
    }
    void use(const std::string& scene_linear, const std::string& spaces) {
        std::string text = kHead;
        text.replace(text.find("%SCENE%"), 7, scene_linear);
        const std::string path = (folder_ / "config.ocio").string();
        std::ofstream(path) << text << spaces;
        setenv("OCIO", path.c_str(), 1);
    }
    static Vec3 convert(const char* from, const char* to, Vec3 color) {
        const auto transform = make_color_transform({from}, {to});
        EXPECT_TRUE(transform) << transform.error().text();
        ImageF3 image(3, 2);
        for (int i = 0; i < 18; ++i)
            image.data()[i] = color[i % 3];
        (*transform)->apply(image);
        return {image.at(2, 1, 0), image.at(2, 1, 1), image.at(2, 1, 2)};
    }
    std::filesystem::path folder_;
};

void expect_near(Vec3 have, Vec3 want) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(have[c], want[c], 2e-6f * (1 + std::abs(want[c])));
}

TEST_F(Ocio, WithoutAConfigOnlyBuiltInNames) {
    EXPECT_EQ(parse_color_space("srgb").value().name, "srgb");
    EXPECT_EQ(parse_color_space("sRGB").value().name, "srgb");
    EXPECT_EQ(parse_color_space("Linear").value().name, "linear");
    const auto other = parse_color_space("ACEScg");
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, ErrorCode::kUsage);
    EXPECT_THAT(other.error().sentence(), HasSubstr("'ACEScg'"));
    EXPECT_THAT(other.error().sentence(), HasSubstr("$OCIO"));
    EXPECT_EQ(make_color_transform({"ACEScg"}, {"srgb"}).error().code, ErrorCode::kUsage);
}

TEST_F(Ocio, SpacesRolesAndAliases) {
    use("lin_rec709_srgb", std::string(kLinear) + kOthers);
    for (const char* name :
         {"doubled", "twice", "scene_linear", "Linear Rec.709 (sRGB)", "SWAPPED"}) {
        EXPECT_TRUE(parse_color_space(name)) << name;
    }
    expect_near(convert("scene_linear", "twice", {0.1f, 0.2f, 5.0f}), {0.2f, 0.4f, 10.0f});
    expect_near(convert("swapped", "doubled", {0.1f, 0.2f, 0.3f}), {0.6f, 0.4f, 0.2f});
    EXPECT_TRUE(make_color_transform({"doubled"}, {"double_gain"}).value()->identity());
    const auto other = parse_color_space("nowhere");
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, ErrorCode::kUsage);
    EXPECT_THAT(other.error().sentence(), HasSubstr("swapped"));
}

TEST_F(Ocio, BuiltInSpacesMeetTheConfigInLinear) {
    use("lin_rec709_srgb", std::string(kLinear) + kOthers);
    expect_near(convert("linear", "doubled", {0.1f, -0.2f, 7.0f}), {0.2f, -0.4f, 14.0f});
    expect_near(convert("srgb", "doubled", {0.5f, 1.0f, 0.0f}), {0.42808229f, 2.0f, 0.0f});
    expect_near(convert("doubled", "srgb", {0.42808229f, 2.0f, 0.0f}), {0.5f, 1.0f, 0.0f});
    expect_near(convert("swapped", "linear", {1.0f, 2.0f, 3.0f}), {3.0f, 2.0f, 1.0f});
}

TEST_F(Ocio, BuiltInSpacesMeetTheConfigInItsTextureSpace) {
    use("doubled", std::string(kOthers) + kTexture);
    expect_near(convert("linear", "doubled", {0.1f, 0.2f, 0.4f}), {0.2f, 0.4f, 0.8f});
    expect_near(convert("doubled", "srgb", {0.42808229f, 2.0f, 0.0f}), {0.5f, 1.0f, 0.0f});
}

TEST_F(Ocio, ConfigWithoutAMeetingPlaceSaysSo) {
    use("doubled", kOthers);
    expect_near(convert("swapped", "doubled", {0.1f, 0.2f, 0.3f}), {0.6f, 0.4f, 0.2f});
    const auto transform = make_color_transform({"srgb"}, {"doubled"});
    ASSERT_FALSE(transform);
    EXPECT_EQ(transform.error().code, ErrorCode::kUsage);
    EXPECT_THAT(transform.error().sentence(), HasSubstr("Rec.709"));
    EXPECT_TRUE(make_color_transform({"srgb"}, {"linear"}));
}

TEST_F(Ocio, NanAndInfinityStay) {
    use("lin_rec709_srgb", std::string(kLinear) + kOthers + kTexture);
    const float inf = INFINITY;
    const Vec3 out = convert("doubled", "sRGB - Texture", {NAN, inf, -0.5f});
    EXPECT_TRUE(std::isnan(out.x));
    EXPECT_EQ(out.y, inf);
    EXPECT_TRUE(std::isfinite(out.z));
}

TEST_F(Ocio, SixteenBitCodesSurviveTheConfigsCurve) {
    use("lin_rec709_srgb", std::string(kLinear) + kTexture);
    ImageF3 image(256, 256);
    for (int i = 0; i < 65536; ++i)
        image.data()[3 * i] = static_cast<float>(i) / 65535.0f;
    make_color_transform({"sRGB - Texture"}, {"linear"}).value()->apply(image);
    make_color_transform({"linear"}, {"sRGB - Texture"}).value()->apply(image);
    for (int i = 0; i < 65536; ++i)
        ASSERT_EQ(std::floor(image.data()[3 * i] * 65535.0f + 0.5f), i);
}

TEST_F(Ocio, ViewsOfAllDisplaysTheDefaultFirst) {
    EXPECT_TRUE(list_screens().value().empty());
    EXPECT_TRUE(list_color_spaces().value().empty());
    use("lin_rec709_srgb", std::string(kLinear) + kOthers);
    const auto screens = list_screens();
    ASSERT_TRUE(screens) << screens.error().text();
    EXPECT_EQ(*screens,
              (std::vector<ScreenName>{{"screen", "Raw"}, {"wall", "Raw"}, {"wall", "Bright"}}));
    EXPECT_THAT(list_color_spaces().value(),
                ElementsAre("raw", "Linear Rec.709 (sRGB)", "doubled", "swapped"));
}

TEST_F(Ocio, AViewTakesLinearLightToTheDisplayUnclamped) {
    use("lin_rec709_srgb", std::string(kLinear) + kOthers);
    const auto view = make_screen_view({"wall", "Bright"});
    ASSERT_TRUE(view) << view.error().text();
    ImageF3 pixel(1, 1);
    pixel.pixel(0, 0)[0] = 0.25f, pixel.pixel(0, 0)[1] = -0.5f, pixel.pixel(0, 0)[2] = 6;
    (*view)->pixels->apply(pixel);
    expect_near({pixel.at(0, 0, 0), pixel.at(0, 0, 1), pixel.at(0, 0, 2)}, {0.5f, -1, 12});
    EXPECT_THAT((*view)->shader.source, HasSubstr("weft_screen"));
}

TEST_F(Ocio, AViewBehindTheTextureSpaceEncodesFirst) {
    use("doubled", std::string(kOthers) + kTexture);
    const auto view = make_screen_view({"wall", "Bright"});
    ASSERT_TRUE(view) << view.error().text();
    ImageF3 pixel(1, 1);
    pixel.pixel(0, 0)[0] = 0.1f, pixel.pixel(0, 0)[1] = 0.2f, pixel.pixel(0, 0)[2] = 2;
    (*view)->pixels->apply(pixel);
    expect_near({pixel.at(0, 0, 0), pixel.at(0, 0, 1), pixel.at(0, 0, 2)}, {0.2f, 0.4f, 4});
}

TEST_F(Ocio, AViewThatCannotBeSaysWhy) {
    EXPECT_EQ(make_screen_view({"wall", "Bright"}).error().code, ErrorCode::kUsage);
    use("lin_rec709_srgb", std::string(kLinear) + kOthers);
    const auto none = make_screen_view({"wall", "Dim"});
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().sentence(), HasSubstr("'Dim'"));
}

TEST_F(Ocio, AViewWithoutAMeetingPlaceSaysSo) {
    use("doubled", kOthers);
    EXPECT_THAT(make_screen_view({"wall", "Bright"}).error().sentence(), HasSubstr("Rec.709"));
}

TEST_F(Ocio, TheTablesOfAConversionAreItsFiles) {
    use("lin_rec709_srgb", std::string(kLinear) + kOthers + R"(  - !<ColorSpace>
    name: graded
    to_scene_reference: !<FileTransform> {src: graded.spi1d, interpolation: linear}
  - !<ColorSpace>
    name: unused
    to_scene_reference: !<FileTransform> {src: unused.spi1d, interpolation: linear}
)");
    const auto luts = folder_ / "luts";
    std::filesystem::create_directory(luts);
    for (const char* name : {"graded.spi1d", "unused.spi1d"}) {
        std::ofstream(luts / name) << "Version 1\nFrom 0 1\nLength 2\nComponents 1\n{\n0\n.5\n}\n";
    }
    expect_near(convert("graded", "linear", {0.5f, 1.0f, 0.2f}), {0.25f, 0.5f, 0.1f});
    const std::string config = (folder_ / "config.ocio").string();
    EXPECT_THAT(color_files({{"srgb"}, {"graded"}}),
                ElementsAre(config, (luts / "graded.spi1d").string()));
    EXPECT_THAT(color_files({{"doubled"}}), ElementsAre(config));
    EXPECT_TRUE(color_files({{"srgb"}, {"linear"}, {"cineon"}}).empty());
}

TEST_F(Ocio, BrokenConfigIsUnreadable) {
    const std::string path = (folder_ / "broken.ocio").string();
    std::ofstream(path) << "this is no config";
    setenv("OCIO", path.c_str(), 1);
    const auto space = parse_color_space("doubled");
    ASSERT_FALSE(space);
    EXPECT_EQ(space.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(space.error().sentence(), HasSubstr(path));
    EXPECT_TRUE(parse_color_space("srgb"));
    setenv("OCIO", (folder_ / "none.ocio").string().c_str(), 1);
    EXPECT_EQ(parse_color_space("doubled").error().code, ErrorCode::kUnreadable);
}

}  // namespace
}  // namespace weft
