// Files that nobody should have written: an error that names the place, and never a crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/project/codec/edit_json.h"
#include "app/project/codec/project_json.h"
#include "engine/core/rng.h"
#include "tests/project/sample_project.h"

namespace weft {
namespace {

using testing::HasSubstr;

struct Hostile {
    const char *name, *json, *says;
};
class HostileFile : public testing::TestWithParam<Hostile> {};

TEST_P(HostileFile, IsRefusedWithItsPlace) {
    const auto project = project_from_json(GetParam().json);
    ASSERT_FALSE(project);
    EXPECT_EQ(project.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(project.error().text(), HasSubstr(GetParam().says));
    EXPECT_EQ(project.error().text().find('\n'), std::string::npos) << "a message is one line";
}

#define WEFT_REGION(body) R"({"schema":"weft.project/1","regions":[{"id":1},{"id":2,)" body "}]}"

INSTANTIATE_TEST_SUITE_P(
    Json, HostileFile,
    testing::Values(
        Hostile{"empty", "", "not valid JSON"}, Hostile{"not_json", "PK\x03\x04", "not valid JSON"},
        Hostile{"cut_off", R"({"schema":"weft.project/1","name":"a)",
                "not valid JSON at line 1, column "},
        Hostile{"place", "{\"schema\":\n  \"weft.project/1\",\n  secret}",
                "not valid JSON at line 3, column 3; correct it or restore a backup"},
        Hostile{"list", "[]", "a list"}, Hostile{"null", "null", "null"},
        Hostile{"no_schema", "{}", "schema: "},
        Hostile{"schema_number", R"({"schema":1})", "schema: "},
        Hostile{"other_schema", R"({"schema":"weft.look/1"})", "weft.look/1"},
        Hostile{"negative_version", R"({"schema":"weft.project/-1"})", "weft.project/-1"},
        Hostile{"huge_version", R"({"schema":"weft.project/99999999999"})",
                "weft.project/99999999999"},
        Hostile{"plate_text", R"({"schema":"weft.project/1","plate":"x"})",
                "plate: This is a string"},
        Hostile{"regions_object", R"({"schema":"weft.project/1","regions":{}})",
                "regions: This is an object"},
        Hostile{"region_number", R"({"schema":"weft.project/1","regions":[3]})",
                "regions[0]: This is a number"},
        Hostile{"name_number", WEFT_REGION(R"("name":3)"), "regions[1].name: "},
        Hostile{"name_zero", WEFT_REGION(R"("name":"a\u0000b")"), "regions[1].name: "},
        Hostile{"scale_text", WEFT_REGION(R"("placement":{"scale":"2"})"),
                "regions[1].placement.scale: "},
        Hostile{"scale_huge", WEFT_REGION(R"("placement":{"scale":1e300})"), "0.001 to 1000"},
        Hostile{"scale_overflow", WEFT_REGION(R"("placement":{"scale":1e999})"), "not valid JSON"},
        Hostile{"scale_nan", WEFT_REGION(R"("placement":{"scale":NaN})"), "not valid JSON"},
        Hostile{"scale_null", WEFT_REGION(R"("placement":{"scale":null})"),
                "regions[1].placement.scale: "},
        Hostile{"warp_text", WEFT_REGION(R"("placement":{"warp":"a"})"), "COLUMNSxROWS"},
        Hostile{"warp_list", WEFT_REGION(R"("placement":{"warp":[{"at":[1,2]}]})"),
                "regions[1].placement.warp"},
        Hostile{"warp_huge", WEFT_REGION(R"("placement":{"warp":{"columns":1e9,"rows":2}})"),
                "regions[1].placement.warp.columns: "},
        Hostile{"warp_no_corners", WEFT_REGION(R"("placement":{"warp":{"columns":2,"rows":2}})"),
                "regions[1].placement.warp.corners: "},
        Hostile{
            "warp_point",
            WEFT_REGION(
                R"("placement":{"warp":{"columns":1,"rows":1,"corners":[[0,0],[9,0],[9,9],[0,9]],"points":[{"at":[0,0]},{"at":[9]},{"at":[0,9]},{"at":[9,9]}]}})"),
            "regions[1].placement.warp.points[1].at: "},
        Hostile{
            "warp_key_twice",
            WEFT_REGION(
                R"("placement":{"warp":{"columns":1,"rows":1,"corners":[[0,0],[9,0],[9,9],[0,9]],"keys":[{"frame":1,"points":[{"at":[0,0]},{"at":[9,0]},{"at":[0,9]},{"at":[9,9]}]},{"frame":1,"points":[{"at":[0,0]},{"at":[9,0]},{"at":[0,9]},{"at":[9,9]}]}]}})"),
            "Frame 1 has two keys"},
        Hostile{
            "warp_fold",
            WEFT_REGION(
                R"("placement":{"warp":{"columns":1,"rows":1,"corners":[[0,0],[90,0],[90,90],[0,90]],"points":[{"at":[0,0]},{"at":[-90,0]},{"at":[0,90]},{"at":[90,90]}]}})"),
            "the grid folds"},
        Hostile{
            "warp_flat",
            WEFT_REGION(
                R"("placement":{"warp":{"columns":1,"rows":1,"corners":[[0,0],[9,0],[0,0],[0,9]]}})"),
            "convex"},
        Hostile{"offset_short", WEFT_REGION(R"("placement":{"offset_px":[1]})"), "two numbers"},
        Hostile{"offset_texts", WEFT_REGION(R"("placement":{"offset_px":["1","2"]})"),
                "must be numbers"},
        Hostile{"corners_seven", WEFT_REGION(R"("placement":{"corners_px":[1,2,3,4,5,6,7]})"),
                "four points"},
        Hostile{"overlap_half", WEFT_REGION(R"("synthesis":{"overlap_px":12.5})"), "whole number"},
        Hostile{"overlap_wraps", WEFT_REGION(R"("synthesis":{"overlap_px":4294967332})"),
                "12 to 2048"},
        Hostile{"overlap_64_bits",
                WEFT_REGION(R"("synthesis":{"overlap_px":18446744073709551615})"), "overlap_px: "},
        Hostile{"seam_unknown", WEFT_REGION(R"("synthesis":{"seam":"magic"})"),
                "graphcut, dp or none"},
        Hostile{"also_text", WEFT_REGION(R"("texture":{"also":"moss.jpg"})"), "a list of paths"},
        Hostile{"also_numbers", WEFT_REGION(R"("texture":{"also":[1]})"), "a list of paths"},
        Hostile{"also_mixed", WEFT_REGION(R"("texture":{"also":["a.jpg",1]})"),
                "must contain numbers"},
        Hostile{"also_empty", WEFT_REGION(R"("texture":{"also":[""]})"), "empty"},
        Hostile{"reference_wraps", WEFT_REGION(R"("reference_frames":[4294967297])"),
                "regions[1].reference_frames: "},
        Hostile{"reference_object", WEFT_REGION(R"("reference_frames":{})"),
                "regions[1].reference_frames: "},
        Hostile{"matte_list", WEFT_REGION(R"("matte":[])"), "regions[1].matte: This is a list"},
        Hostile{"amendment_kind",
                WEFT_REGION(R"("amendments":[{"kind":"x","runs":[[1,2,3,4,5]]}])"),
                "amendments[0].kind: "},
        Hostile{"amendment_short_run",
                WEFT_REGION(R"("amendments":[{"kind":"keep","runs":[[1,2]]}])"), "runs[0]: "},
        Hostile{"amendment_huge",
                WEFT_REGION(R"("amendments":[{"kind":"keep","runs":[[1,2,3,4,99999999999]]}])"),
                "runs[0]: "},
        Hostile{"amendment_length",
                WEFT_REGION(R"("amendments":[{"kind":"keep","runs":[[1,2,0,4,5]]}])"), "runs[0]: "},
        Hostile{"amendment_empty", WEFT_REGION(R"("amendments":[{"kind":"keep","runs":[]}])"),
                "amendments[0]"},
        Hostile{"confirmed_no_area",
                WEFT_REGION(R"("matte":{"confirmed":[{"frame":1,"path":"a"}]})"),
                "matte.confirmed[0].area: "},
        Hostile{"confirmed_twice",
                WEFT_REGION(R"("matte":{"confirmed":[{"frame":1,"path":"a","area":"b"},)"
                            R"({"frame":1,"path":"a","area":"b"}]})"),
                "listed twice"},
        Hostile{"confirmed_zero",
                WEFT_REGION(R"("matte":{"confirmed":[{"frame":1,"path":"a\u0000b","area":"b"}]})"),
                "matte.confirmed[0].path: "},
        Hostile{"confirmed_text", WEFT_REGION(R"("matte":{"confirmed":"a.png"})"),
                "matte.confirmed: "},
        Hostile{"keyframe_no_frame", WEFT_REGION(R"("matte":{"keyframes":[{"path":"a"}]})"),
                "matte.keyframes[0].frame: "},
        Hostile{"keyframe_wraps",
                WEFT_REGION(R"("matte":{"keyframes":[{"frame":4294967308,"path":"a"}]})"),
                "keyframes[0].frame: "},
        Hostile{
            "keyframe_twice",
            WEFT_REGION(R"("matte":{"keyframes":[{"frame":1,"path":"a"},{"frame":1,"path":"b"}]})"),
            "two keyframes"},
        Hostile{"holdout_text", WEFT_REGION(R"("holdouts":["a"])"), "regions[1].holdouts[0]: "},
        Hostile{"zone_text", WEFT_REGION(R"("zones":["a"])"), "regions[1].zones[0]: "},
        Hostile{"zone_kind", WEFT_REGION(R"("zones":[{"kind":"fog"}])"),
                "regions[1].zones[0].kind: "},
        Hostile{"zone_value", WEFT_REGION(R"("zones":[{"value":7}])"),
                "regions[1].zones[0].value: "},
        Hostile{"id_twice", WEFT_REGION(R"("name":"x"},{"id":1)"),
                "regions[2].id: Two regions have the id 1"},
        Hostile{"id_negative", WEFT_REGION(R"("name":"x"},{"id":-1)"), "regions[2].id: "},
        Hostile{"id_wraps", WEFT_REGION(R"("name":"x"},{"id":4294967297)"), "regions[2].id: "},
        Hostile{"key_twice", WEFT_REGION(R"("name":"x","name":"y")"), "occurs twice"},
        Hostile{"not_utf8", WEFT_REGION("\"name\":\"\xff\""), "not valid JSON"},
        Hostile{"version_0_matte", R"({"schema":"weft.project/0","regions":[{"matte":3}]})",
                "regions[0].matte: "},
        Hostile{"version_0_frame", R"({"schema":"weft.project/0","regions":[{"matte":{"x":"a"}}]})",
                "not a frame number"},
        Hostile{"version_0_group",
                R"({"schema":"weft.project/0","regions":[{"scale":1,"placement":3}]})",
                "placement: "}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(HostileJson, NestingBombsAreRefused) {
    for (const char* bracket : {"[", "{\"a\":"}) {
        std::string text = R"({"schema":"weft.project/1","x":)";
        for (int i = 0; i < 2'000'000; ++i)
            text += bracket;
        const auto project = project_from_json(text);
        ASSERT_FALSE(project);
        EXPECT_THAT(project.error().text(), HasSubstr("nested more than"));
    }
}

TEST(HostileJson, HugeFilesAreRefused) {
    std::string text = R"({"schema":"weft.project/1","name":")";
    text.resize(100'000'000, 'a');
    text += "\"}";
    const auto project = project_from_json(text);
    ASSERT_FALSE(project);
    EXPECT_THAT(project.error().text(), HasSubstr("MB"));
}

TEST(HostileJson, TooManyKeysAreRefused) {
    std::string text = R"({"schema":"weft.project/1")";
    for (int i = 0; i < 5000; ++i)
        text += ",\"k" + std::to_string(i) + "\":0";
    const auto project = project_from_json(text + "}");
    ASSERT_FALSE(project);
    EXPECT_THAT(project.error().text(), HasSubstr("keys"));
}

/// A copy of `text` with a place or two flipped, cut, doubled, or replaced by a word of JSON.
std::string mutated(std::string text, std::uint64_t seed) {
    Rng rng(seed);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(rng.below(n)); };
    static constexpr const char* kWords[] = {"null",    "-1",  "1e308", "[]",         "{}",
                                             "\"",      ",",   "[[",    "4294967296", "true",
                                             "\\u0000", "0.5", "\"\""};
    const std::size_t changes = 1 + below(2);
    for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
        const std::size_t at = below(text.size());
        const std::size_t length = std::min<std::size_t>(below(40), text.size() - at);
        const std::string word = kWords[below(std::size(kWords))];
        switch (below(12)) {
            case 0:
                text[at] = static_cast<char>(below(256));
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                text.insert(at, text.substr(below(text.size()), length));
                break;
            case 3:
                text.replace(at, length, word);
                break;
            default: {
                // A whole value or a digit of it: most mutants stay well-formed, so the readers see
                // them.
                const std::size_t value = text.find(": ", at);
                if (value == std::string::npos) break;
                const std::size_t end = std::min(text.find_first_of(",\n}", value), text.size());
                const std::size_t digit = text.find_first_of("0123456789", value);
                if (below(2) == 0 && digit < end)
                    text[digit] = static_cast<char>('0' + below(10));
                else
                    text.replace(value + 2, end - value - 2, word);
            }
        }
    }
    return text;
}

TEST(HostileJson, ThousandsOfMutantsNeitherCrashNorLie) {
    const auto valid = project_to_json(test::full_project());
    ASSERT_TRUE(valid);
    int accepted = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 6000; ++seed) {
        const auto project = project_from_json(
            mutated(seed % 3 == 0 ? test::json_with_unknown_keys() : *valid, seed));
        if (!project) {
            ++refused;
            EXPECT_FALSE(project.error().sentence().empty());
            continue;
        }
        ++accepted;
        const auto written = project_to_json(*project);
        ASSERT_TRUE(written) << seed;
        const auto again = project_from_json(*written);
        ASSERT_TRUE(again) << seed << ": " << again.error().text();
        ASSERT_TRUE(*again == *project) << "mutant " << seed << ":\n" << *written;
    }
    // Both must have been exercised, or the mutations were too tame or too wild.
    EXPECT_GT(accepted, 300);
    EXPECT_GT(refused, 300);
}

TEST(HostileJson, MutatedActionFilesDoNotCrash) {
    const std::string valid = R"([
  {"action": "add_region", "region": {"name": "wall", "texture": {"sample": "s.png"}}, "index": 0},
  {"action": "set_region_parameter", "region": "wall", "key": "placement.scale", "value": 2},
  {"action": "set_matte_keyframe", "region": "wall", "frame": 12, "path": "a.png"},
  {"action": "move_region", "region": 1, "index": 0},
  {"action": "set_holdouts", "region": 1, "holdouts": [{"files": "h.png"}]},
  {"action": "set_zones", "region": 1, "zones": [{"value": 0.5, "matte": {"files": "z.png"}}]}
])";
    int applied = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        const auto edits = edits_from_json(mutated(valid, seed));
        if (edits && apply_edits(Project{}, *edits)) ++applied;
    }
    EXPECT_GT(applied, 50);
    EXPECT_LT(applied, 2900);
}

}  // namespace
}  // namespace weft
