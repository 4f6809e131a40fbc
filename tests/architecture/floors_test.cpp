// An include may only point to its own folder or a lower floor. These tables are the rule that
// docs/ARCHITECTURE.md summarises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "tests/architecture/include_rules.h"
#include "tests/architecture/product_sources.h"
#include "tests/support/places.h"

namespace weft::architecture {
namespace {

const std::vector<Floor> kFloors{
    // 0
    {"engine/core", {}},
    // 1
    {"engine/compute", {"engine/core"}},
    // 2: files and colour
    {"engine/media", {"engine/core"}},
    {"engine/color", {"engine/core"}},
    // 2: algorithms, each using others only in the direction in which data flows
    {"engine/motion", {"engine/core", "engine/compute"}},
    {"engine/form", {"engine/core", "engine/motion"}},
    {"engine/mask", {"engine/core", "engine/compute", "engine/motion"}},
    {"engine/seam", {"engine/core", "engine/compute"}},
    {"engine/synthesis", {"engine/core", "engine/compute", "engine/seam"}},
    {"engine/temporal",
     {"engine/core", "engine/compute", "engine/motion", "engine/mask", "engine/seam",
      "engine/synthesis"}},
    {"engine/lighting",
     {"engine/core", "engine/compute", "engine/color", "engine/motion", "engine/mask",
      "engine/temporal"}},
    {"engine/composite",
     {"engine/core", "engine/compute", "engine/color", "engine/mask", "engine/lighting"}},
    {"engine/metrics",
     {"engine/core", "engine/compute", "engine/color", "engine/motion", "engine/mask",
      "engine/seam", "engine/synthesis", "engine/temporal", "engine/lighting"}},
    // 3
    {"engine/pipeline",
     {"engine/core", "engine/compute", "engine/color", "engine/motion", "engine/form",
      "engine/mask", "engine/seam", "engine/synthesis", "engine/temporal", "engine/lighting",
      "engine/composite", "engine/metrics"}},
    {"gpu", {"engine/core", "engine/compute"}},
    // 3: the texture library
    {"texture_db/describe", {"engine/core"}},
    {"texture_db/starter", {"engine/core"}},
    {"texture_db/catalogue", {"engine/core", "texture_db/describe"}},
    {"texture_db/search", {"engine/core", "texture_db/describe", "texture_db/catalogue"}},
    {"texture_db/recommend",
     {"engine/core", "texture_db/describe", "texture_db/catalogue", "texture_db/search"}},
    {"texture_db/library",
     {"engine/core", "engine/media", "texture_db/describe", "texture_db/starter",
      "texture_db/catalogue", "texture_db/search", "texture_db/recommend"}},
    {"texture_db/sources",
     {"engine/core", "engine/media", "texture_db/describe", "texture_db/catalogue",
      "texture_db/library"}},
    // 4: the document uses lower floors only through headers that define parameter types; its codec
    // also uses the function that writes files
    {"app/project",
     {"engine/core", "engine/composite/blend_mode.h", "engine/compute/wrap_mode.h",
      "engine/form/depth_positions.h", "engine/form/form_guide.h", "engine/lighting/lamp.h",
      "engine/lighting/light_source.h", "engine/lighting/shading.h", "engine/mask/matte_reach.h",
      "engine/mask/roto_shape.h", "engine/pipeline/layer_kind.h", "engine/pipeline/zone_kind.h",
      "engine/seam/seam.h", "engine/seam/seam_cost.h", "engine/synthesis/plane_amendment.h",
      "engine/synthesis/plane_mode.h", "engine/temporal/surface_kind.h",
      "engine/temporal/temporal_mode.h", "engine/media/image_files.h"}},
    {"app/project/codec", {"engine/core", "engine/media/atomic_file.h", "app/project"}},
    // 5: shared by the command line and the editor
    {"app/base", {"engine/core", "engine/color", "engine/media", "app/project"}},
    {"app/exchange", {"engine", "texture_db", "app/project", "app/base"}},
    {"app/shot", {"engine", "texture_db", "app/project", "app/base", "app/exchange"}},
    {"app/cache", {"engine", "app/project", "app/base", "app/exchange", "app/shot"}},
    {"app/composites", {"engine/core"}},
    {"app/render",
     {"engine", "gpu", "app/project", "app/base", "app/exchange", "app/shot", "app/cache",
      "app/composites"}},
    {"app/farm",
     {"engine", "app/project", "app/base", "app/exchange", "app/shot", "app/cache", "app/render"}},
    {"app/motion_export",
     {"engine", "app/project", "app/base", "app/exchange", "app/shot", "app/cache", "app/render"}},
    {"app/flatten",
     {"engine", "app/project", "app/base", "app/exchange", "app/shot", "app/cache", "app/render"}},
    {"app/measure",
     {"engine", "app/project", "app/base", "app/exchange", "app/shot", "app/cache", "app/render"}},
    // 5: the research harness, beside the product
    {"bench/baselines", {"engine/core", "engine/compute"}},
    {"bench/shot", {"engine", "bench/baselines"}},
    {"bench/study",
     {"engine", "app/project", "app/base", "app/exchange", "app/shot", "app/cache", "app/render",
      "app/measure", "bench/baselines"}},
    {"bench/retrieval",
     {"engine/core", "engine/media", "texture_db/describe", "texture_db/catalogue",
      "texture_db/search", "texture_db/library", "texture_db/sources"}},
    {"bench/synthesis_bench.cpp", {"engine"}},
    // 6: the editor's rooms; the command line sees none of them
    {"app/jobs", {"engine", "app/project", "app/base"}},
    {"app/mattes", {"engine", "app/project", "app/base"}},
    {"app/textures", {"engine", "texture_db", "app/project", "app/base"}},
    {"app/preview",
     {"engine", "app/project", "app/base", "app/shot", "app/cache", "app/render", "app/mattes",
      "app/textures"}},
    // what a session takes and shows
    {"app/session",
     {"engine", "app/project", "app/base", "app/exchange", "app/jobs", "app/mattes",
      "app/preview"}},
    // its parts, and the session that has them all
    {"app/session/document",
     {"engine/core", "engine/media", "app/project", "app/base", "app/exchange", "app/mattes",
      "app/session/action.h", "app/session/session_view.h"}},
    {"app/session/viewer",
     {"engine/color", "app/project", "app/base", "app/mattes", "app/preview", "app/shot",
      "app/session/action.h", "app/session/session_view.h", "app/session/document"}},
    {"app/session/mattes",
     {"engine/core", "engine/form", "engine/mask", "engine/media", "app/project", "app/base",
      "app/exchange", "app/mattes", "app/preview", "app/shot", "app/session/action.h",
      "app/session/session_view.h", "app/session/document", "app/session/viewer"}},
    {"app/session/textures",
     {"engine/core", "engine/media", "engine/synthesis", "texture_db", "app/project", "app/base",
      "app/exchange", "app/textures", "app/session/action.h", "app/session/document"}},
    {"app/session/jobs",
     {"engine/core", "engine/media", "engine/metrics", "engine/motion", "app/project", "app/base",
      "app/exchange", "app/jobs", "app/mattes", "app/preview", "app/shot", "app/session/action.h",
      "app/session/session_view.h", "app/session/document", "app/session/viewer"}},
    {"app/session/session_parts.h",
     {"app/mattes", "app/preview", "app/session/session.h", "app/session/document",
      "app/session/viewer", "app/session/mattes", "app/session/textures", "app/session/jobs"}},
    {"app/session/session_parts.cpp",
     {"app/project", "app/session/session_parts.h", "app/session/timeline_marks.h"}},
    {"app/session/session_actions.cpp",
     {"app/project", "app/base", "app/mattes", "app/session/session_parts.h"}},
    {"app/session/session.h",
     {"engine/media", "app/base", "app/session/action.h", "app/session/session_view.h"}},
    {"app/session/session.cpp", {"app/session/session.h", "app/session/session_parts.h"}},
    // 7: the panels, a room for what an artist does
    {"ui/input", {}},
    {"ui/base",
     {"engine/core", "app/project", "app/base", "app/textures", "app/session/action.h",
      "app/session/session_view.h", "ui/input"}},
    {"ui/widgets", {"ui/base"}},
    {"ui/parameters", {"engine/core", "app/project", "app/mattes", "ui/base", "ui/widgets"}},
    {"ui/canvas", {"engine/core", "app/base", "ui/base"}},
    {"ui/mask",
     {"engine/core", "app/project", "app/mattes", "ui/base", "ui/widgets", "ui/parameters",
      "ui/canvas"}},
    {"ui/form",
     {"engine/core", "app/project", "ui/base", "ui/widgets", "ui/parameters", "ui/canvas"}},
    {"ui/placement",
     {"engine/core", "app/project", "ui/base", "ui/widgets", "ui/canvas", "ui/form"}},
    {"ui/texture",
     {"engine/core", "ui/base", "ui/widgets", "ui/parameters", "ui/canvas", "ui/form",
      "ui/placement"}},
    {"ui/motion", {"ui/base", "ui/widgets", "ui/parameters", "ui/canvas", "ui/mask"}},
    {"ui/light",
     {"app/project", "app/textures", "ui/base", "ui/widgets", "ui/parameters", "ui/canvas"}},
    {"ui/review", {"ui/base", "ui/widgets"}},
    {"ui/jobs",
     {"engine/core", "app/base", "app/render", "ui/base", "ui/widgets", "ui/parameters"}},
    {"ui/timeline", {"app/project", "ui/base", "ui/widgets"}},
    {"ui/files", {"ui/base", "ui/widgets", "ui/parameters"}},
    {"ui/windows", {"engine/core", "ui/base", "ui/widgets", "ui/parameters"}},
    {"ui/viewer",
     {"ui/base", "ui/widgets", "ui/canvas", "ui/mask", "ui/form", "ui/placement", "ui/texture",
      "ui/motion", "ui/light"}},
    {"ui/inspector",
     {"ui/base", "ui/widgets", "ui/mask", "ui/texture", "ui/motion", "ui/light", "ui/review"}},
    {"ui/shell",
     {"app/project", "app/base", "ui/base", "ui/widgets", "ui/placement", "ui/texture", "ui/motion",
      "ui/light", "ui/review", "ui/jobs", "ui/timeline", "ui/files", "ui/windows", "ui/viewer",
      "ui/inspector"}},
    // 8
    {"app/editor",
     {"engine", "texture_db", "app/project", "app/base", "app/session/session.h", "ui/input",
      "ui/base", "ui/parameters", "ui/canvas", "ui/shell"}},
    {"app/cli/texture",
     {"engine", "texture_db", "bench/retrieval", "app/base", "app/exchange", "app/render",
      "app/project", "app/cli/answer.h", "app/cli/command_line.h", "app/cli/console.h",
      "app/cli/option_values.h", "app/cli/write_flags.h"}},
    {"app/cli/bench",
     {"engine", "app/cli/answer.h", "app/cli/commands.h", "app/cli/console.h",
      "app/cli/engine_choice.h"}},
    {"app/cli/flatten",
     {"engine/core", "engine/media", "app/project", "app/exchange", "app/flatten",
      "app/cli/answer.h", "app/cli/command_line.h", "app/cli/commands.h", "app/cli/console.h",
      "app/cli/option_values.h"}},
    {"app/cli/form",
     {"engine/core", "app/project", "app/render", "app/cli/answer.h", "app/cli/command_line.h",
      "app/cli/commands.h", "app/cli/region_flags.h"}},
    {"app/cli/motion",
     {"engine/core", "engine/media", "app/project", "app/motion_export", "app/cli/answer.h",
      "app/cli/command_line.h", "app/cli/commands.h", "app/cli/console.h",
      "app/cli/option_values.h"}},
    {"app/cli",
     {"engine", "gpu", "texture_db", "app/project", "app/base", "app/exchange", "app/shot",
      "app/render", "app/farm", "app/measure", "bench"}},
    {"app/cli/cli.cpp", {"app/render", "app/cli"}},
    {"app/processor_check.cpp", {"engine/core"}},
    {"app/main.cpp", {"engine", "gpu", "texture_db", "ui", "app"}},
};

const std::vector<Library> kLibraries{
    {"OpenCV",
     {"opencv2/", "opencv4/"},
     {"engine/media", "engine/motion", "engine/form", "engine/mask", "engine/synthesis",
      "engine/seam", "engine/temporal", "engine/lighting", "engine/composite", "engine/metrics",
      "texture_db", "app/render", "app/mattes", "app/preview", "bench"}},
    {"OpenImageIO",
     {"OpenImageIO/"},
     {"engine/media", "engine/media/exr_part.h", "engine/media/picture_file.h"}},
    {"Eigen",
     {"Eigen/"},
     {"engine/form", "engine/mask", "engine/form/eigen_types.h", "engine/form/rigid_bundle.h",
      "engine/form/rigid_pose.h"}},
    {"libdeflate", {"libdeflate.h"}, {"engine/media"}},
    {"FFmpeg",
     {"libavcodec/", "libavformat/", "libavutil/", "libswscale/"},
     {"engine/media"},
     true},
    {"OpenColorIO", {"OpenColorIO/"}, {"engine/color"}},
    {"nlohmann-json",
     {"nlohmann/"},
     {"app", "texture_db", "bench", "app/project/codec/json_codec.h",
      "app/exchange/merge_settings.h", "app/measure/measure_report.h", "app/render/form_report.h",
      "app/render/light_report.h", "app/render/report.h", "app/cli/answer.h",
      "app/cli/bench/bench_lighting.h", "app/cli/texture/texture_json.h",
      "bench/shot/shot_bench.h"}},
    {"CLI11", {"CLI/"}, {"app/cli", "app/main.cpp"}, true},
    {"CUDA",
     {"cuda", "cub/", "thrust/", "cufft", "cooperative_groups", "device_launch_parameters"},
     {"gpu"},
     true},
    {"SQLite", {"sqlite3"}, {"texture_db"}},
    {"libzip", {"zip.h", "zipconf.h"}, {"engine/media"}},
    {"Dear ImGui", {"imgui", "backends/imgui"}, {"ui", "app/editor"}, true},
    {"GLFW and OpenGL", {"GLFW/", "GL/", "EGL/", "glad/", "epoxy/"}, {"app/editor"}, true},
    {"X11", {"X11/"}, {"app/editor"}, true},
};

TEST(Floors, EveryIncludePointsDownwards) {
    const std::vector<SourceFile> files = product_sources();
    ASSERT_GT(files.size(), 20u) << "the source tree was not found in " << test::source_folder();
    for (const SourceFile& file : files)
        for (const std::string& broken :
             broken_rules(file.path, file.contents, kFloors, kLibraries))
            ADD_FAILURE() << broken;
}

// ---- reading ----------------------------------------------------------------------------------

// All reading goes through engine/core/input_file.h. Libraries that open files by name are called
// only where the file was checked: `guard` occurs in the same file.
const std::vector<ReadRule> kReadRules{
    {"std::ifstream", "", {}},
    {"std::fstream", "", {}},
    {"std::filebuf", "", {}},
    {"fopen(", "", {}},
    {"::open(",
     "",
     {{"engine/core/input_file.cpp", "this is the one way"},
      {"engine/core/file_lock.cpp", "takes the file's lock; reads nothing"},
      {"engine/media/atomic_file.cpp", "flushes what was written; reads nothing"}}},
    {"ImageInput::open(", "", {}},
    {"ImageInput::create(",
     "",
     {{"engine/media/picture_file.cpp", "chooses the reader by the first bytes"}}},
    {"imread(", "check_picture_file(", {}},
    {"VideoCapture", "check_input_file(", {}},
    {"avformat_open_input(", "check_input_file(", {}},
    {"sqlite3_open", "check_input_file(", {}},
    {"zip_open(", "check_input_file(", {}},
    {"CreateFromFile(", "check_input_file(", {}},
    {"AddFontFromFileTTF(", "check_input_file(", {}},
};

TEST(Reading, GoesThroughOneFunction) {
    for (const SourceFile& file : product_sources())
        for (const std::string& broken : broken_reads(file.path, file.contents, kReadRules))
            ADD_FAILURE() << broken;
}

TEST(Reading, CheckerJudgesAsMeant) {
    const auto check = [](std::string_view path, std::string_view text) {
        return broken_reads(path, text, kReadRules);
    };
    EXPECT_THAT(check("app/cli/a.cpp", "int a;\nstd::ifstream file(path);\n"),
                testing::ElementsAre(testing::HasSubstr("app/cli/a.cpp:2: ")));
    EXPECT_EQ(check("ui/a.cpp", "const int f = ::open(path, O_RDONLY);\n").size(), 1u);
    EXPECT_THAT(check("engine/core/input_file.cpp", "::open(path, O_RDONLY);\n"),
                testing::IsEmpty());
    // Ignores methods, other functions of the same name, and comments.
    EXPECT_THAT(check("ui/a.cpp", "auto l = Library::open(path);\n// std::ifstream would wait\n"),
                testing::IsEmpty());
    EXPECT_EQ(check("engine/media/a.cpp", "auto i = OIIO::ImageInput::open(path);\n").size(), 1u);
    EXPECT_THAT(check("engine/media/a.cpp",
                      "WEFT_CHECK_OK(check_picture_file(path));\ncv::imread(path);\n"),
                testing::IsEmpty());
}

// ---- the tables ------------------------------------------------------------------------------

TEST(FloorTable, HasNoCycle) {
    // Repeatedly removes folders whose dependencies are all removed.
    const auto covers = [](std::string_view folder, std::string_view used) {
        return folder == used || folder.starts_with(std::string(used) + "/") ||
               used.starts_with(std::string(folder) + "/");
    };
    std::vector<Floor> left = kFloors;
    for (bool found = true; found && !left.empty();) {
        found = false;
        for (std::size_t i = 0; i < left.size() && !found; ++i) {
            bool rests_on_others = false;
            for (const std::string_view used : left[i].may_use)
                for (std::size_t j = 0; j < left.size(); ++j)
                    rests_on_others = rests_on_others || (j != i && covers(left[j].folder, used));
            if (rests_on_others) continue;
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
            found = true;
        }
    }
    for (const Floor& floor : left)
        ADD_FAILURE() << floor.folder << " is part of a cycle";
}

TEST(FloorTable, NamesEachFolderOnce) {
    std::vector<std::string_view> folders;
    for (const Floor& floor : kFloors)
        folders.push_back(floor.folder);
    std::sort(folders.begin(), folders.end());
    EXPECT_EQ(std::adjacent_find(folders.begin(), folders.end()), folders.end());
}

// ---- the checker itself ----------------------------------------------------------------------

std::vector<std::string> check(std::string_view path, std::string_view contents) {
    return broken_rules(path, contents, kFloors, kLibraries);
}

struct Case {
    std::string_view path, contents;
    std::string_view says;  ///< Empty: allowed.
};
class Checker : public testing::TestWithParam<Case> {};

TEST_P(Checker, JudgesAsMeant) {
    const auto broken = check(GetParam().path, GetParam().contents);
    if (GetParam().says.empty()) {
        EXPECT_THAT(broken, testing::IsEmpty());
        return;
    }
    ASSERT_EQ(broken.size(), 1u);
    EXPECT_THAT(broken[0], testing::HasSubstr(std::string(GetParam().says)));
}

// Its index in the list and its file.
std::string name_of_case(const testing::TestParamInfo<Case>& info) {
    std::string name = std::to_string(info.index) + "_";
    for (const char c : info.param.path)
        name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(
    Floors, Checker,
    testing::Values(
        Case{"engine/core/a.cpp", "#include \"engine/core/b.h\"\n", ""},
        Case{"engine/core/a.cpp", "#include \"engine/seam/seam.h\"\n",
             "engine/core/a.cpp:1: engine/core may not use \"engine/seam/seam.h\""},
        Case{"engine/core/a.cpp", "// first\n  #  include \t\"app/project/edit.h\" // why\n",
             "a.cpp:2: "},
        Case{"engine/seam/a.h", "#include \"engine/synthesis/b.h\"\n", "may not use"},
        Case{"engine/synthesis/a.h", "#include \"engine/seam/b.h\"\n", ""},
        Case{"engine/pipeline/a.cpp", "#include \"engine/media/frame_reader.h\"\n", "may not use"},
        Case{"engine/pipeline/a.cpp", "#include \"engine/lighting/shading.h\"", ""},
        Case{"engine/core/a.cpp", "#include \"engine/corelike/b.h\"\n",
             "no file of a known folder"},
        Case{"engine/seam/a.cpp", "#include \"b.h\"\n", "path from the root"},
        Case{"engine/seam/a.cpp", "#include \"../core/b.h\"\n", "path from the root"},
        Case{"engine/newcomer/a.cpp", "int a;\n", "has no floor"},
        Case{"app/project/a.cpp", "#include \"engine/seam/seam.h\"\n", ""},
        Case{"app/project/a.cpp", "#include \"engine/seam/grid.h\"\n", "may not use"},
        Case{"app/project/a.cpp", "#include \"app/session/job.h\"\n", "may not use"},
        Case{"app/project/a.cpp", "#include \"app/project/codec/json_codec.h\"\n", "may not use"},
        Case{"app/project/codec/a.cpp", "#include \"app/project/edit.h\"\n", ""},
        Case{"app/session/a.cpp", "#include \"app/project/codec/project_file.h\"\n", ""},
        Case{"app/session/a.cpp", "#include \"app/cli/b.h\"\n", "may not use"},
        Case{"app/session/document/a.h", "#include \"app/session/action.h\"\n", ""},
        Case{"app/session/document/a.h", "#include \"app/session/session.h\"\n", "may not use"},
        Case{"app/session/viewer/a.h", "#include \"app/session/mattes/b.h\"\n", "may not use"},
        Case{"app/session/action.h", "#include \"app/session/document/b.h\"\n", "may not use"},
        Case{"ui/base/a.cpp", "#include \"app/session/session.h\"\n", "may not use"},
        Case{"app/cli/a.cpp", "#include \"app/session/session.h\"\n", "may not use"},
        Case{"app/cli/a.cpp", "#include \"app/preview/preview.h\"\n", "may not use"},
        Case{"app/cli/a.cpp", "#include \"app/render/render_job.h\"\n", ""},
        Case{"app/render/a.cpp", "#include \"app/mattes/paint.h\"\n", "may not use"},
        Case{"app/render/a.cpp", "#include \"bench/study/study.h\"\n", "may not use"},
        Case{"texture_db/search/a.cpp", "#include \"texture_db/library/library.h\"\n",
             "may not use"},
        Case{"texture_db/starter/a.cpp", "#include \"texture_db/catalogue/index.h\"\n",
             "may not use"},
        Case{"app/main.cpp", "#include \"app/cli/cli.h\"\n", ""},
        Case{"ui/mask/a.cpp", "#include \"engine/seam/seam.h\"\n", "may not use"},
        Case{"ui/mask/a.cpp", "#include \"ui/canvas/handles.h\"\n", ""},
        Case{"ui/mask/a.cpp", "#include \"ui/viewer/viewer.h\"\n", "may not use"},
        Case{"ui/a.cpp", "int a;\n", "has no floor"},
        Case{"engine/seam/a.cpp", "#include <vector>\n#include <glm/vec2.hpp>\n", ""},
        Case{"engine/seam/a.cpp", "// #include \"app/x.h\" is not one\nauto s = \"#include\";\n",
             ""},
        Case{"engine/mask/a.cpp", "#include <opencv2/imgproc.hpp>\n", ""},
        Case{"engine/mask/a.h", "#include <opencv2/core.hpp>\n", "not be used in a header"},
        Case{"engine/mask/a.h", "#include \"opencv2/core.hpp\"\n", "not be used in a header"},
        Case{"engine/core/a.cpp", "#include <opencv2/core.hpp>\n", "OpenCV may not be used here"},
        Case{"app/project/a.cpp", "#include <opencv2/core.hpp>\n", "OpenCV may not be used here"},
        Case{"app/project/a.cpp", "#include <nlohmann/json.hpp>\n", ""},
        Case{"app/project/codec/json_codec.h", "#include <nlohmann/json.hpp>\n", ""},
        Case{"app/project/edit.h", "#include <nlohmann/json_fwd.hpp>\n", "not be used in a header"},
        Case{"engine/metrics/a.cpp", "#include <nlohmann/json.hpp>\n",
             "nlohmann-json may not be used here"},
        Case{"engine/compute/a.cpp", "#include <cuda_runtime.h>\n", "CUDA may not be used here"},
        Case{"gpu/a.cu", "#include <cuda_runtime.h>\n", ""},
        Case{"app/session/a.cpp", "#include <CLI/CLI.hpp>\n", "CLI11 may not be used here"},
        Case{"ui/shell/a.cpp", "#include <GLFW/glfw3.h>\n", "GLFW"}),
    name_of_case);

TEST(CheckerReports, EveryViolationOfAFile) {
    EXPECT_EQ(
        check("engine/core/a.h",
              "#include \"engine/seam/a.h\"\n#include <opencv2/core.hpp>\n#include \"gpu/b.h\"\n")
            .size(),
        3u);
}

}  // namespace
}  // namespace weft::architecture
