#include "app/project/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>

namespace weft {
namespace {

using testing::HasSubstr;

const Parameter<Region>& region_parameter(std::string_view key) {
    const auto found = find_parameter(region_parameters(), key);
    if (!found) throw std::logic_error(found.error().sentence());
    return **found;
}

std::vector<ParameterInfo> all_parameters() {
    std::vector<ParameterInfo> out;
    for (const auto& p : region_parameters())
        out.push_back(p);
    for (const auto& p : project_parameters())
        out.push_back(p);
    return out;
}

TEST(Parameters, FlagsAreUniqueOverBothTables) {
    std::set<std::string_view> flags;
    for (const ParameterInfo& p : all_parameters())
        if (!p.flag.empty()) {
            EXPECT_TRUE(p.flag.starts_with("--")) << p.flag;
            EXPECT_TRUE(flags.insert(p.flag).second) << p.flag;
        }
    EXPECT_GE(flags.size(), 30u);
}

TEST(Parameters, KeysAreUniqueInATable) {
    std::set<std::string> keys;
    for (const auto& p : region_parameters())
        EXPECT_TRUE(keys.insert(p.full_key()).second) << p.full_key();
    keys.clear();
    for (const auto& p : project_parameters())
        EXPECT_TRUE(keys.insert(p.full_key()).second) << p.full_key();
}

TEST(Parameters, DefaultsAreAllowedAndHelpIsThere) {
    for (const ParameterInfo& p : all_parameters()) {
        const auto normal = normalise(p, p.default_value);
        ASSERT_TRUE(normal) << normal.error().text();
        EXPECT_EQ(*normal, p.default_value) << p.full_key();
        EXPECT_GT(p.help.size(), 10u) << p.full_key();
        EXPECT_FALSE(p.help.ends_with('.')) << p.full_key();
        const bool numeric = p.kind == ParameterKind::kInteger || p.kind == ParameterKind::kNumber;
        if (numeric) {
            EXPECT_LT(p.min, p.max) << p.full_key();
        }
    }
}

TEST(Parameters, DefaultsAreTheDocumentedOnes) {
    const auto text = [](std::string_view key) {
        const auto& p = region_parameter(key);
        return format_parameter(p, p.default_value);
    };
    EXPECT_EQ(text("--scale"), "1");
    EXPECT_EQ(text("--rotate"), "0");
    EXPECT_EQ(text("--offset"), "0,0");
    EXPECT_EQ(text("--overlap"), "36");
    EXPECT_EQ(text("--feather"), "0");
    EXPECT_EQ(text("--seam"), "graphcut");
    EXPECT_EQ(text("--temporal"), "locked");
    EXPECT_EQ(text("--temporal-blend"), "0.2");
    EXPECT_EQ(text("--temporal-weight"), "1");
    EXPECT_EQ(text("--light"), "plate");
    EXPECT_EQ(text("--blend-mode"), "gain");
    EXPECT_EQ(text("--light-strength"), "1");
    const auto movie_start = find_parameter(project_parameters(), "--movie-start");
    ASSERT_TRUE(movie_start);
    EXPECT_EQ((*movie_start)->default_value, ParameterValue(std::int64_t{1001}));
}

TEST(Parameters, EveryFlagOfTheCommandLineIsInATable) {
    std::set<std::string_view> flags;
    for (const ParameterInfo& p : all_parameters())
        flags.insert(p.flag);
    for (const char* flag : {"--plate",
                             "--movie-start",
                             "--plate-layer",
                             "--matte-value",
                             "--matte-channel",
                             "--matte-invert",
                             "--matte-stabilize",
                             "--matte-frozen",
                             "--matte-frozen-files",
                             "--frames",
                             "--texture",
                             "--scale",
                             "--rotate",
                             "--offset",
                             "--corners",
                             "--fit",
                             "--plane",
                             "--reference-frame",
                             "--motion",
                             "--motion-direction",
                             "--track",
                             "--scale-keys",
                             "--rotate-keys",
                             "--offset-keys",
                             "--form-amount-keys",
                             "--seam",
                             "--overlap",
                             "--temporal",
                             "--temporal-blend",
                             "--temporal-weight",
                             "--surface",
                             "--light",
                             "--blend-mode",
                             "--light-strength",
                             "--lines",
                             "--lines-invert",
                             "--extract-lines",
                             "--line-width",
                             "--feather",
                             "--quality",
                             "--seed",
                             "--plate-space",
                             "--texture-space",
                             "--working-space",
                             "--out-space"})
        EXPECT_TRUE(flags.contains(flag)) << flag;
}

// The editor shows it as a tooltip, the command line beside the flag.
TEST(Parameters, HelpNamesNoFlag) {
    const std::regex flag("--[a-z]");
    for (const ParameterInfo& p : all_parameters())
        EXPECT_FALSE(std::regex_search(std::string(p.help), flag))
            << p.full_key() << ": " << p.help;
}

TEST(Parameters, TextsReachTheRightMember) {
    Region region;
    const auto set = [&](std::string_view flag, std::string_view text) {
        const auto status = set_parameter_text(region, region_parameter(flag), text);
        EXPECT_TRUE(status) << status.error().text();
    };
    set("--scale", "2.5");
    set("--offset", "-3,4.5");
    set("--corners", "0,0 10,0 10,5 0,5");
    set("--reference-frame", "40,12,20-22,12");
    set("--seam", "dp");
    set("--overlap", "24");
    set("--matte-value", "7");
    set("--matte-invert", "true");
    set("--texture-also", "moss 2.jpg\nlib/moss,3.png");
    set("--rotations", "true");
    set("--align", "false");
    set("--refine", "5");
    set("--seam-cost", "paper");
    EXPECT_EQ(region.texture.also, (std::vector<std::string>{"moss 2.jpg", "lib/moss,3.png"}));
    EXPECT_EQ(
        format_parameter(region_parameter("--texture-also"), ParameterValue(region.texture.also)),
        "moss 2.jpg\nlib/moss,3.png");
    EXPECT_TRUE(region.synthesis.rotations);
    EXPECT_FALSE(region.synthesis.mirror);
    EXPECT_FALSE(region.synthesis.align);
    EXPECT_EQ(region.synthesis.refine, 5);
    EXPECT_EQ(region.synthesis.seam_cost, SeamCost::kPaper);
    EXPECT_EQ(region.placement.scale, 2.5);
    EXPECT_EQ(region.placement.offset_px, (PlatePoint{-3, 4.5}));
    ASSERT_TRUE(region.placement.corners_px);
    EXPECT_EQ((*region.placement.corners_px)[2], (PlatePoint{10, 5}));
    EXPECT_EQ(region.reference_frames, (std::vector<int>{40, 12, 20, 21, 22}))
        << "the first given holds the placement";
    EXPECT_EQ(region.synthesis.seam, SeamMethod::kDynamicProgramming);
    EXPECT_EQ(region.synthesis.overlap_px, 24);
    EXPECT_EQ(region.matte->select.value, 7);
    EXPECT_TRUE(region.matte->select.invert);
    EXPECT_FALSE(Region().matte->select.invert) << "the default leaf was changed in place";
    set("--corners", "none");
    EXPECT_FALSE(region.placement.corners_px);
}

TEST(Parameters, LightTakesAChoiceOrAPicture) {
    Region region;
    const auto& light = region_parameter("--light");
    ASSERT_TRUE(set_parameter_text(region, light, "lights/warm.exr"));
    EXPECT_EQ(region.light.source, LightSource::kImage);
    EXPECT_EQ(region.light.image, "lights/warm.exr");
    ASSERT_TRUE(set_parameter_text(region, light, "none"));
    EXPECT_EQ(region.light.source, LightSource::kNone);
    EXPECT_EQ(allowed_values(light), "plate, none, painted or a path");
}

TEST(Parameters, FramesAreKeptOnceInTheOrderGiven) {
    const auto& frozen = region_parameter("--matte-frozen");
    Region region;
    ASSERT_TRUE(set_parameter_text(region, frozen, "7,3-5,4,7,1-50000,1-50000"));
    const std::vector<int>& frames = region.matte->frozen;
    ASSERT_EQ(frames.size(), 50000u);
    EXPECT_EQ((std::vector<int>(frames.begin(), frames.begin() + 5)),
              (std::vector<int>{7, 3, 4, 5, 1}));
    EXPECT_FALSE(set_parameter_text(region, frozen, "1-600000,1-600000"));
}

TEST(Parameters, FormatIsReadBack) {
    for (const auto& p : region_parameters()) {
        Region region;
        const std::string text = format_parameter(p, p.read(region));
        const auto value = parse_parameter(p, text);
        ASSERT_TRUE(value) << p.full_key() << ": " << value.error().text();
        EXPECT_EQ(*value, p.default_value) << p.full_key();
    }
}

struct Wrong {
    const char *flag, *text, *says;
};
class WrongText : public testing::TestWithParam<Wrong> {};

TEST_P(WrongText, NamesParameterValueAndRange) {
    const auto& p = region_parameter(GetParam().flag);
    Region region;
    const auto status = set_parameter_text(region, p, GetParam().text);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::kUsage);
    EXPECT_THAT(status.error().text(), HasSubstr(p.full_key()));
    EXPECT_THAT(status.error().text(), HasSubstr(GetParam().says));
    EXPECT_EQ(region, Region()) << "a refused value must change nothing";
}

INSTANTIATE_TEST_SUITE_P(
    Parameters, WrongText,
    testing::Values(
        Wrong{"--scale", "0", "must be 0.001 to 1000 plate px per sample px, not 0"},
        Wrong{"--scale", "nan", "0.001 to 1000"}, Wrong{"--scale", "inf", "0.001 to 1000"},
        Wrong{"--scale", "2,5", "'2,5'"}, Wrong{"--scale", "", "a number"},
        Wrong{"--scale", "1e999", "a number"}, Wrong{"--overlap", "11", "12 to 2048 px"},
        Wrong{"--overlap", "12.5", "whole number"},
        Wrong{"--overlap", "99999999999999999999", "whole number"},
        Wrong{"--seam", "graph", "graphcut, dp or none"},
        Wrong{"--light-strength", "2.5", "0 to 2"}, Wrong{"--light-detail", "1.5", "0 to 1"},
        Wrong{"--multiply", "1,2", "three numbers"}, Wrong{"--multiply", "-1", "0 to 100"},
        Wrong{"--layer-blend", "add", "normal, multiply"}, Wrong{"--offset", "3", "two numbers"},
        Wrong{"--offset", "3,x", "two numbers"}, Wrong{"--corners", "0,0 1,1", "four points"},
        Wrong{"--matte-invert", "maybe", "true or false"},
        Wrong{"--reference-frame", "9-1", "9-1"}));

TEST(Parameters, ColoursAreThreeNumbersOrOneForAll) {
    const auto& p = region_parameter("--multiply");
    Region region;
    ASSERT_TRUE(set_parameter_text(region, p, "0.5, 1 2"));
    EXPECT_EQ(region.grade.multiply, (RgbNumbers{0.5, 1, 2}));
    EXPECT_EQ(format_parameter(p, p.read(region)), "0.5,1,2");
    ASSERT_TRUE(set_parameter_text(region, p, "0.25"));
    EXPECT_EQ(region.grade.multiply, (RgbNumbers{0.25, 0.25, 0.25}));
}

TEST(Parameters, AutoUnsetsWhatMayBeUnset) {
    Region region;
    ASSERT_TRUE(set_parameter_text(region, region_parameter("--light-tint"), "0.5"));
    EXPECT_EQ(region.light.cast, 0.5);
    ASSERT_TRUE(set_parameter_text(region, region_parameter("--light-tint"), "auto"));
    EXPECT_FALSE(region.light.cast);
}

TEST(Parameters, AnUnknownNameGetsTheNearest) {
    const auto found = find_parameter(region_parameters(), "--scael");
    ASSERT_FALSE(found);
    EXPECT_THAT(found.error().sentence(), HasSubstr("placement.scale"));
}

TEST(MatteText, ConfirmedPartsHaveAMatteAndAnArea) {
    MatteSource matte;
    ASSERT_TRUE(add_confirmed_text(matte, "30=a.png,area.png"));
    ASSERT_TRUE(add_confirmed_text(matte, "-3=m=1,2.png,b.png"));
    EXPECT_EQ(matte.confirmed.at(30), (ConfirmedEdge{"a.png", "area.png"}));
    EXPECT_EQ(matte.confirmed.at(-3), (ConfirmedEdge{"m=1,2.png", "b.png"}));
    EXPECT_FALSE(add_confirmed_text(matte, "30=b.png,c.png")) << "twice on one frame";
    for (const char* text : {"", "31", "31=", "31=a.png", "31=,b.png", "31=a.png,", "a.png,b.png",
                             "=a.png,b.png", "3x=a.png,b.png", "999999999=a.png,b.png"})
        EXPECT_FALSE(add_confirmed_text(matte, text)) << text;
    EXPECT_EQ(matte.confirmed.size(), 2u);
}

TEST(MatteText, KeyframesAndPatterns) {
    MatteSource matte;
    ASSERT_TRUE(add_matte_text(matte, "12=a.png"));
    ASSERT_TRUE(add_matte_text(matte, "-3=x=y.png"));
    EXPECT_EQ(matte.keyframes.at(12).path, "a.png");
    EXPECT_EQ(matte.keyframes.at(-3).path, "x=y.png");
    EXPECT_FALSE(add_matte_text(matte, "12=b.png")) << "two mattes for one frame";
    EXPECT_FALSE(add_matte_text(matte, "masks/####.png")) << "a pattern beside keyframes";
    EXPECT_FALSE(add_matte_text(matte, "13="));
    MatteSource files;
    ASSERT_TRUE(add_matte_text(files, "v1=final/####.png"));
    EXPECT_EQ(files.files, "v1=final/####.png");
    EXPECT_FALSE(add_matte_text(files, "12=a.png"));
}

}  // namespace
}  // namespace weft
