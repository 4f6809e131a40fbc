// Length limits of functions and files. Longer ones are listed here with a reason, and removed once
// they are short enough.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/architecture/function_lengths.h"
#include "tests/architecture/product_sources.h"

namespace weft::architecture {
namespace {

constexpr int kFunctionLines = 60;
constexpr int kFileLines = 400;
constexpr int kMostFileLines = 450;
constexpr int kRoomLines = 4500;

struct LongFunction {
    std::string_view path, name;
    int at_most = 0;  ///< Allowed number of lines.
};
struct SizeException {
    std::string_view why;
    std::vector<LongFunction> functions;
};

const std::vector<SizeException> kLongFunctions{
    {"A table: one entry after the other, nothing nested.",
     {{"app/cli/synth_command_line.cpp", "add_synth", 95},
      {"app/project/project_parameters.cpp", "make_project_table", 130},
      {"app/project/form_parameters.cpp", "form_parameters", 85},
      {"app/project/look_parameters.cpp", "grade_entries", 70},
      {"app/project/look_parameters.cpp", "light_entries", 110},
      {"app/project/region_parameters.cpp", "make_region_table", 350},
      {"app/project/matte_parameters.cpp", "edge_entries", 80},
      {"app/project/matte_parameters.cpp", "matte_entries", 76},
      {"texture_db/describe/material_words.cpp", "material_table", 70},
      {"ui/shell/command_table.cpp", "add_view_commands", 95}}},
    {"A recipe of one material: layers in the order in which they are drawn, all on one picture.",
     {{"texture_db/starter/grounds.cpp", "concrete", 75},
      {"texture_db/starter/grounds.cpp", "dirt", 65},
      {"texture_db/starter/grounds.cpp", "plaster", 75},
      {"texture_db/starter/hides.cpp", "leather", 95},
      {"texture_db/starter/hides.cpp", "scales", 70},
      {"texture_db/starter/masonry.cpp", "brick", 95},
      {"texture_db/starter/masonry.cpp", "cobblestone", 70},
      {"texture_db/starter/masonry.cpp", "stone", 95},
      {"texture_db/starter/masonry.cpp", "tiles", 105},
      {"texture_db/starter/metals.cpp", "metal", 125},
      {"texture_db/starter/metals.cpp", "rubber", 75},
      {"texture_db/starter/metals.cpp", "rust", 65},
      {"texture_db/starter/minerals.cpp", "ceramic", 85},
      {"texture_db/starter/minerals.cpp", "marble", 70},
      {"texture_db/starter/minerals.cpp", "water", 75},
      {"texture_db/starter/papers.cpp", "paper", 100},
      {"texture_db/starter/papers.cpp", "wallpaper", 75},
      {"texture_db/starter/relief.cpp", "Relief::photograph", 70},
      {"texture_db/starter/roofs.cpp", "roof", 100},
      {"texture_db/starter/strands.cpp", "foliage", 100},
      {"texture_db/starter/strands.cpp", "fur", 80},
      {"texture_db/starter/strands.cpp", "grass", 90},
      {"texture_db/starter/strands.cpp", "straw", 100},
      {"texture_db/starter/carpets.cpp", "carpet", 70},
      {"texture_db/starter/textiles.cpp", "knit", 120},
      {"texture_db/starter/textiles.cpp", "weave", 145},
      {"texture_db/starter/woods.cpp", "bark", 70},
      {"texture_db/starter/woods.cpp", "wood", 110}}},
    {"A panel from top to bottom: the order of its widgets is what there is to read.",
     {{"ui/files/browser.cpp", "accept", 65},
      {"ui/files/browser.cpp", "file_browser", 95},
      {"ui/inspector/inspector.cpp", "region_list", 100},
      {"ui/jobs/page.cpp", "job_row", 70},
      {"ui/light/inspector.cpp", "light_inspector", 80},
      {"ui/light/lamps.cpp", "lamps_controls", 70},
      {"ui/mask/inspector.cpp", "mask_inspector", 110},
      {"ui/motion/inspector.cpp", "motion_inspector", 65},
      {"ui/shell/shell.cpp", "Shell::layout", 125},
      {"ui/shell/welcome.cpp", "welcome", 70},
      {"ui/texture/drawer.cpp", "materials", 100},
      {"ui/texture/inspector.cpp", "texture_inspector", 90},
      {"ui/timeline/timeline.cpp", "tracks", 70},
      {"ui/timeline/timeline.cpp", "transport", 70},
      {"ui/viewer/overlays.cpp", "draw_provenance", 65},
      {"ui/viewer/viewer.cpp", "viewer", 95},
      {"ui/widgets/rows.cpp", "slider", 66},
      {"ui/windows/palette.cpp", "command_palette", 70},
      {"ui/windows/tour.cpp", "tour", 85}}},
    {"One short case for each kind of action or step; the list is to be read as one.",
     {{"app/editor/script.cpp", "ScriptRunner::step", 105},
      {"app/preview/preview_overlay.cpp", "OverlayMaker::make", 70},
      {"ui/parameters/parameters.cpp", "parameter_control", 105}}},
    {"One pass whose steps use nearly all of its local values.",
     {{"app/base/folder_lister.cpp", "list_folder", 65},
      {"app/preview/preview_render.cpp", "Preview::Impl::open_shot_of", 65},
      {"app/preview/preview_flicker.cpp", "Preview::Impl::step_flicker", 70},
      {"engine/composite/focus_map.cpp", "fit_focus", 65},
      {"engine/composite/grain_meter.cpp", "GrainMeter::model", 65},
      {"engine/synthesis/direct_search.cpp", "DirectSearch::add_layer", 70},
      {"texture_db/describe/descriptor_model.cpp", "learn_descriptor", 80},
      {"texture_db/search/word_reader.cpp", "WordReader::read", 80}}},
};

struct LongFile {
    std::string_view path, why;
    int at_most = kMostFileLines;
};

const std::vector<LongFile> kLongFiles{
    {"app/project/parameter_values.cpp", "each kind of value: its check, its text, its JSON"},
    {"bench/study/study_html.cpp", "one page, section by section"},
    {"engine/motion/surface_fit.cpp", "one solver, whose equations share their sums"},
    {"texture_db/starter/grounds.cpp", "one family of recipes"},
};

const LongFunction* exception_for(std::string_view path, std::string_view name) {
    for (const SizeException& reason : kLongFunctions)
        for (const LongFunction& f : reason.functions)
            if (f.path == path && f.name == name) return &f;
    return nullptr;
}

int lines_of(const SourceFile& file) {
    return static_cast<int>(std::count(file.contents.begin(), file.contents.end(), '\n'));
}

TEST(Sizes, FunctionsOverSixtyLinesHaveAReason) {
    std::map<std::pair<std::string, std::string>, int> longest;
    for (const SourceFile& file : product_sources())
        for (const FunctionLength& f : function_lengths(file.contents)) {
            int& lines = longest[{file.path, f.name}];
            lines = std::max(lines, f.lines);
        }
    ASSERT_GT(longest.size(), 2000u) << "the functions of the source tree were not found";
    for (const auto& [place, lines] : longest) {
        const LongFunction* allowed = exception_for(place.first, place.second);
        EXPECT_LE(lines, allowed ? allowed->at_most : kFunctionLines)
            << place.first << ": " << place.second
            << ": split it, or give a reason in sizes_test.cpp";
    }
    for (const SizeException& reason : kLongFunctions)
        for (const LongFunction& f : reason.functions) {
            const auto found = longest.find({std::string(f.path), std::string(f.name)});
            EXPECT_TRUE(found != longest.end() && found->second > kFunctionLines)
                << f.path << ": " << f.name << " needs no exception: take it off the list";
        }
}

TEST(Sizes, FilesOverFourHundredLinesHaveAReason) {
    std::map<std::string, int, std::less<>> lines;
    for (const SourceFile& file : product_sources())
        lines[file.path] = lines_of(file);
    for (const auto& [path, count] : lines) {
        const auto allowed = std::ranges::find(kLongFiles, path, &LongFile::path);
        EXPECT_LE(count, allowed == kLongFiles.end() ? kFileLines : allowed->at_most)
            << path << ": split it, or give a reason in sizes_test.cpp";
    }
    for (const LongFile& file : kLongFiles) {
        const auto found = lines.find(file.path);
        EXPECT_TRUE(found != lines.end() && found->second > kFileLines)
            << file.path << " needs no exception: take it off the list";
    }
}

TEST(Sizes, NoRoomOfTheAppOrTheUiIsOverFourAndAHalfThousandLines) {
    std::map<std::string, int> rooms;
    for (const SourceFile& file : product_sources())
        if (file.path.starts_with("app/") || file.path.starts_with("ui/"))
            rooms[file.path.substr(0, file.path.find_last_of('/'))] += lines_of(file);
    for (const auto& [room, lines] : rooms)
        EXPECT_LE(lines, kRoomLines) << room;
}

// ---- the counter itself ----------------------------------------------------------------------

std::vector<std::string> counted(std::string_view source) {
    std::vector<std::string> out;
    for (const FunctionLength& f : function_lengths(source))
        out.push_back(f.name + " " + std::to_string(f.line) + "+" + std::to_string(f.lines));
    return out;
}

TEST(FunctionLengths, FindsWhatHasABody) {
    using testing::ElementsAre;
    EXPECT_THAT(counted("int f();\nint g(int a) {\n    return a;\n}\n"), ElementsAre("g 2+3"));
    EXPECT_THAT(counted("namespace a::b {\nclass C {\n  public:\n    void m() const {\n    }\n};\n"
                        "void C::n()\n    noexcept {\n}\n}\n"),
                ElementsAre("m 4+2", "C::n 7+3"));
    EXPECT_THAT(counted("struct S : B {\n    int k = 3;\n    std::vector<int> v{1, 2};\n};\n"
                        "enum class E { kA, kB };\nint f() { return 0; }\n"),
                testing::Contains("f 6+1"));
    EXPECT_THAT(
        counted("template <class T>\nauto f(T t) -> std::vector<T> {\n    return {t};\n}\n"),
        ElementsAre("f 1+4"));
    EXPECT_THAT(counted("bool A::operator==(const A& b) const {\n    return true;\n}\n"),
                ElementsAre("A::operator== 1+3"));
}

TEST(FunctionLengths, CountsTheInitialisersOfAConstructor) {
    EXPECT_THAT(counted("C::C(int a)\n    : a_(a),\n      b_{1, 2},\n      c_{} {\n    go();\n}\n"),
                testing::ElementsAre("C::C 1+6"));
}

TEST(FunctionLengths, IsNotMisledByBracesInTextCommentsAndMacros) {
    EXPECT_THAT(
        counted("int f() {\n    // }}}\n    /* } */ char c = '}';\n"
                "    auto s = \"}\\\"}\";\n    auto r = R\"x(})\" })x\";\n"
                "    int n = 1'000;\n#define X {{{ \\\n    {{{\n    return 1;\n}\nint g() {\n}\n"),
        testing::ElementsAre("f 1+10", "g 11+2"));
}

TEST(FunctionLengths, ALambdaBelongsToWhatIsAroundIt) {
    EXPECT_THAT(
        counted("void f() {\n    const auto g = [&](int a) {\n        return a;\n    };\n}\n"),
        testing::ElementsAre("f 1+5"));
    EXPECT_THAT(counted("const auto kAll = [] {\n    return 1;\n}();\nint f() {\n}\n"),
                testing::ElementsAre("kAll 1+3", "f 4+2"));
    EXPECT_THAT(counted("void g(F f = [] { return 1; }) {\n    f();\n}\n"),
                testing::ElementsAre("g 1+3"));
}

}  // namespace
}  // namespace weft::architecture
