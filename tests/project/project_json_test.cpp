#include "app/project/codec/project_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>

#include "app/project/parameters.h"
#include "tests/project/sample_project.h"

namespace weft {
namespace {

using test::full_project;
using test::json_with_unknown_keys;
using testing::HasSubstr;

Project read(const std::string& text) {
    auto project = project_from_json(text);
    if (!project) throw std::runtime_error(project.error().text());
    return *project;
}
std::string write(const Project& project) {
    auto text = project_to_json(project);
    if (!text) throw std::runtime_error(text.error().text());
    return *text;
}

TEST(ProjectJson, SampleDiffersFromEveryDefault) {
    // Guards the round trip below: a member that keeps its default would not be tested by it.
    const Project project = full_project();
    for (const auto& p : project_parameters())
        EXPECT_NE(p.read(project), p.default_value) << p.full_key();
    for (const auto& p : region_parameters())
        if (p.full_key() != "matte.files") {
            EXPECT_NE(p.read(*project.regions[0]), p.default_value) << p.full_key();
        }
}

TEST(ProjectJson, EverythingSurvivesARoundTrip) {
    const Project project = full_project();
    EXPECT_EQ(read(write(project)), project);
}

TEST(ProjectJson, TheSameProjectGivesTheSameBytes) {
    const std::string once = write(full_project());
    EXPECT_EQ(write(read(once)), once);
    EXPECT_TRUE(once.starts_with("{\n  \"schema\": \"weft.project/6\",\n")) << once.substr(0, 60);
    EXPECT_TRUE(once.ends_with("}\n"));
    EXPECT_THAT(once, HasSubstr("\"scale\": 0.1,"));
    EXPECT_THAT(once, HasSubstr("\"seed\": 9007199254740991"));
}

TEST(ProjectJson, TheLocaleDoesNotMatter) {
    const std::string once = write(full_project());
    const char* german = std::setlocale(LC_ALL, "de_DE.UTF-8");
    if (!german) GTEST_SKIP() << "the locale de_DE.UTF-8 is not installed";
    const std::string again = write(read(once));
    std::setlocale(LC_ALL, "C");
    EXPECT_EQ(again, once);
}

TEST(ProjectJson, UnknownKeysSurviveAtEveryLevel) {
    const std::string text = write(read(json_with_unknown_keys()));
    for (const char* key : {"future_top", "future_plate", "future_color", "future_settings",
                            "future_output", "future_region", "future_matte", "future_key",
                            "future_holdout", "future_zone", "future_texture", "future_placement",
                            "future_motion", "future_synthesis", "future_temporal", "future_light"})
        EXPECT_THAT(text, HasSubstr("\"" + std::string(key) + "\"")) << text;
    EXPECT_THAT(text, HasSubstr("\"future_region\": \"ä\""));
    EXPECT_THAT(text, HasSubstr("\"big\": 1e+300"));
    EXPECT_EQ(write(read(text)), text);
}

TEST(ProjectJson, MissingKeysHaveTheirDefaults) {
    const Project project =
        read(R"({"schema": "weft.project/6", "regions": [{"name": "a"}, {"id": 5}, {}]})");
    ASSERT_EQ(project.regions.size(), 3u);
    Region expected;
    expected.id = 6;  // after the largest that is given
    expected.name = "a";
    EXPECT_EQ(*project.regions[0], expected);
    EXPECT_EQ(project.regions[2]->id, 7u);
    EXPECT_EQ(project.next_region_id, 8u);
    EXPECT_EQ(project.settings.quality, Quality::kFinal);
}

TEST(ProjectJson, AnEmptyTextDoesNotComeBackAsItsDefault) {
    Project project;
    project.output.exr_compression.clear();
    EXPECT_EQ(read(write(project)), project);
}

TEST(ProjectJson, UpgradesThePreReleaseForm) {
    const Project project = read(R"({
        "schema": "weft.project/0",
        "plate": "frames/####.png", "output": "out/####.png", "frames": "1-40", "seed": 3, "quality": "draft",
        "kept": 1,
        "regions": [
          {"id": 1, "name": "wall", "matte": {"12": "a.png", "-4": "b.png"}, "texture": "brick.jpg", "scale": 1.5,
           "rotate": 10, "offset": [3, 4], "seam": "dp", "overlap": 24, "temporal": "paper",
           "light": "E.png", "light_form": "literal", "light_strength": 0.5, "kept_too": 2},
          {"id": 2, "matte": "m/####.png", "plane": "p.png", "light": "none"}]})");
    Project expected;
    expected.plate.path = "frames/####.png";
    expected.output.path = "out/####.png";
    expected.settings = {Quality::kDraft, 3, "1-40", "", {}};
    expected.extra = {{"kept", "1"}};
    Region wall;
    wall.id = 1;
    wall.name = "wall";
    MatteSource painted;
    painted.keyframes = {{-4, {"b.png", {}}}, {12, {"a.png", {}}}};
    wall.matte = painted;
    wall.texture.sample = "brick.jpg";
    wall.placement.scale = 1.5;
    wall.placement.rotate_deg = 10;
    wall.placement.offset_px = {3, 4};
    wall.synthesis.seam = SeamMethod::kDynamicProgramming;
    wall.synthesis.overlap_px = 24;
    wall.temporal.mode = TemporalMode::kPaper;
    wall.light.source = LightSource::kImage;
    wall.light.image = "E.png";
    wall.light.form = LightForm::kLiteral;
    wall.light.strength = 0.5;
    wall.extra = {{"kept_too", "2"}};
    Region second;
    second.id = 2;
    MatteSource files;
    files.files = "m/####.png";
    second.matte = files;
    second.texture.plane = "p.png";
    second.light.source = LightSource::kNone;
    for (Region* region : {&wall, &second})  // what later versions do of their own accord
        region->light.cast = 0, region->grade.match = 0, region->form.source = FormSource::kPass,
        region->texture.mode = PlaneMode::kSynthesize;
    expected.regions = {Leaf(wall), Leaf(second)};
    expected.next_region_id = 3;
    EXPECT_EQ(project, expected);
    EXPECT_THAT(write(project), HasSubstr("\"weft.project/6\""));
}

// A new region lays a periodic sample on one lattice; one that was saved before keeps its plane.
TEST(ProjectJson, ThePlaneOfVersion3Stays) {
    const Project saved = read(R"({"schema": "weft.project/3", "regions": [
        {"id": 1, "texture": {"sample": "a.png"}}, {"id": 2}]})");
    EXPECT_EQ(saved.regions[0]->texture.mode, PlaneMode::kSynthesize);
    EXPECT_EQ(saved.regions[0]->texture.sample, "a.png");
    EXPECT_EQ(saved.regions[1]->texture.mode, PlaneMode::kSynthesize);
    const Project fresh = read(R"({"schema": "weft.project/6", "regions": [
        {"id": 1, "texture": {"sample": "a.png"}}]})");
    EXPECT_EQ(fresh.regions[0]->texture.mode, PlaneMode::kAuto);
}

// A new region is matched to the plate; one that was saved before that keeps its look.
TEST(ProjectJson, TheLookOfVersion2Stays) {
    const Project project = read(R"({"schema": "weft.project/2", "regions": [
        {"id": 1, "matte": {"files": "a.png"}},
        {"id": 2, "matte": {"files": "a.png"}, "light": {"cast": 0.5, "strength": 0.7}}]})");
    EXPECT_EQ(project.regions[0]->grade.match, 0.0);
    EXPECT_EQ(project.regions[0]->light.cast, 0.0);
    EXPECT_EQ(project.regions[1]->light.cast, 0.5);
    EXPECT_EQ(project.regions[1]->light.strength, 0.7);
    EXPECT_EQ(Region{}.grade.match, 1.0);
    EXPECT_FALSE(Region{}.light.cast);
}

// A new region takes its form from the clip; one that was saved before that stays as it lay.
TEST(ProjectJson, RegionsOfVersion3KeepTheirForm) {
    const Project project = read(R"({"schema": "weft.project/3", "regions": [
        {"id": 1}, {"id": 2, "form": {"position": "P.exr"}}, {"id": 3, "form": {"source": "flat"}}]})");
    EXPECT_EQ(project.regions[0]->form.source, FormSource::kPass);
    EXPECT_EQ(project.regions[1]->form.source, FormSource::kPass);
    EXPECT_EQ(project.regions[1]->form.position, "P.exr");
    EXPECT_EQ(project.regions[2]->form.source, FormSource::kFlat);
    EXPECT_EQ(Region{}.form.source, FormSource::kAuto);
    EXPECT_EQ(read(write(project)), project);
}

TEST(ProjectJson, UpgradesTheTextsOfVersion1) {
    const Project project = read(R"({
        "schema": "weft.project/1", "output": {"layers": "patch,st"},
        "regions": [{"id": 1,
          "matte": {"keyframes": [{"frame": 3, "path": "a.png", "shape_between": true,
                     "shape": {"points": [[1, 2, 0, 0, 0, 0, 4], [9, 2, 0, 0, 1, 0, 4], [5, 8, 0, 0, 0, 0, 0]]}}]},
          "placement": {"scale_keys": "1:1 24:1.5", "offset_keys": "1:0,0 24:10,5", "future": 1},
          "light": {"strength_keys": "1:1 24:1.5", "lamps": "point 320,180 200 1.5"}}]})");
    const Region& region = *project.regions[0];
    EXPECT_EQ(project.output.layers, (std::vector{LayerKind::kPatch, LayerKind::kSt}));
    EXPECT_EQ(region.placement.scale_keys, *parse_keyed_numbers("1:1 24:1.5"));
    EXPECT_EQ(region.placement.offset_keys, *parse_keyed_numbers("1:0,0 24:10,5", 2));
    EXPECT_EQ(region.light.strength_keys, *parse_keyed_numbers("1:1 24:1"));
    EXPECT_EQ(region.light.lamps, *parse_lamps("point 320,180 200 1.5"));
    const MatteKeyframe& key = region.matte->keyframes.at(3);
    ASSERT_TRUE(key.shape);
    EXPECT_TRUE(key.shape_between);
    EXPECT_EQ(key.shape->points[1], (RotoPoint{{9, 2}, {0, 0}, {1, 0}, 4}));
    EXPECT_EQ(read(write(project)), project);
}

TEST(ProjectJson, KeysHaveTheirInterpolation) {
    const auto keys = [](const char* key) {
        return project_from_json(
            std::string(
                R"({"schema": "weft.project/6", "regions": [{"id": 1, "form": {"amount_keys": [)") +
            key + R"(]}}]})");
    };
    const Project project = keys(R"({"frame": 1, "value": 0, "interpolation": "smooth"},
                                    {"frame": 9, "value": 1})")
                                .value();
    EXPECT_EQ(keyed_text(project.regions[0]->form.amount_keys), "1:0:smooth 9:1");
    EXPECT_EQ(read(write(project)), project);
    EXPECT_THAT(write(project), testing::Not(HasSubstr("linear"))) << "as it was written before";
    for (const char* wrong : {R"({"frame": 1, "value": 0, "interpolation": "bezier"})",
                              R"({"frame": 1, "value": 0, "interpolation": 2})",
                              R"({"frame": 1, "value": 0, "interpolation": null})"}) {
        const auto refused = keys(wrong);
        ASSERT_FALSE(refused) << wrong;
        EXPECT_THAT(refused.error().text(),
                    testing::AllOf(HasSubstr("regions[0].form.amount_keys[0].interpolation"),
                                   HasSubstr("smooth")));
    }
    EXPECT_FALSE(keys(R"({"frame": 1, "value": 1.5})")) << "an amount is at most 1";
}

TEST(ProjectJson, AShapeOverTimeIsReadBack) {
    const char* text = R"({"schema": "weft.project/6", "regions": [{"id": 1, "matte": {"shape":
        {"follow": "planar", "track": "t.json", "keys": [
            {"frame": 3, "points": [[1, 2, 0, 0, 0, 0, 4], [9, 2, 0, 0, 1, 0, 4], [5, 8, 0, 0, 0, 0, 0]]}]}}}]})";
    const Project project = read(text);
    const KeyedShape& shape = project.regions[0]->matte->shape;
    EXPECT_EQ(shape.follow, ShapeFollow::kPlanar);
    EXPECT_EQ(shape.track, "t.json");
    EXPECT_EQ(shape.keys.at(3).points[1], (RotoPoint{{9, 2}, {0, 0}, {1, 0}, 4}));
    EXPECT_TRUE(project.regions[0]->matte->by_frame());
    EXPECT_EQ(read(write(project)), project);
    const Project moved = map_paths(project, [](const std::string& p) { return "x/" + p; });
    EXPECT_EQ(moved.regions[0]->matte->shape.track, "x/t.json");
    const auto refused = [&](const std::string& from, const std::string& to, const char* where) {
        std::string changed = text;
        changed.replace(changed.find(from), from.size(), to);
        const auto wrong = project_from_json(changed);
        ASSERT_FALSE(wrong) << to;
        EXPECT_THAT(wrong.error().text(), HasSubstr(where)) << to;
    };
    refused("\"planar\"", "\"3d\"", "shape.follow");
    refused("\"planar\"", "7", "shape.follow");
    refused("\"t.json\"", "[]", "shape.track");
    refused("\"keys\"", "\"key\"", "shape.key");
    refused("[9, 2, 0, 0, 1, 0, 4]", "[9, 2]", "keys[0].points[1]");
    refused("[9, 2, 0, 0, 1, 0, 4]", "[1e60, 2, 0, 0, 1, 0, 4]", "keys[0].points[1]");
    refused("\"frame\": 3", "\"frame\": 3e18", "keys[0].frame");
}

TEST(ProjectJson, WhatVersion1CouldNotRenderIsAnErrorWithItsPlace) {
    const auto refused = project_from_json(
        R"({"schema": "weft.project/1", "regions": [{"light": {"lamps": "torch 1 2"}}]})");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().text(), HasSubstr("regions[0].light.lamps"));
}

TEST(ProjectJson, ANewerVersionIsRefusedWithWhatToDo) {
    const auto project = project_from_json(R"({"schema": "weft.project/7"})");
    ASSERT_FALSE(project);
    EXPECT_EQ(project.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(project.error().text(), HasSubstr("version 7"));
    EXPECT_THAT(project.error().text(), HasSubstr("up to version 6"));
    EXPECT_THAT(project.error().text(), HasSubstr("update Weft"));
}

TEST(ProjectJson, ANameThatIsNotUtf8IsRefusedNotMangled) {
    Project project;
    project.plate.path = "frames/\xff####.png";
    const auto text = project_to_json(project);
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().code, ErrorCode::kUsage);
    EXPECT_THAT(text.error().text(), HasSubstr("UTF-8"));
}

}  // namespace
}  // namespace weft
