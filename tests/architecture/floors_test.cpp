// An include may only point to its own folder or downwards. These two tables are the rule; what
// docs/ARCHITECTURE.md says in words stands here once as an allow-list.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "tests/architecture/include_rules.h"

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
    {"engine/baselines", {"engine/core", "engine/compute"}},
    {"engine/metrics",
     {"engine/core", "engine/compute", "engine/color", "engine/motion", "engine/mask",
      "engine/seam", "engine/synthesis", "engine/temporal", "engine/lighting"}},
    // 3
    {"engine/pipeline",
     {"engine/core", "engine/compute", "engine/color", "engine/motion", "engine/mask",
      "engine/seam", "engine/synthesis", "engine/temporal", "engine/lighting", "engine/composite",
      "engine/metrics"}},
    {"gpu", {"engine/core", "engine/compute"}},
    {"texture_db",
     {"engine/core", "engine/media", "engine/color", "engine/seam", "engine/synthesis",
      "engine/metrics"}},
    // 4: the document knows lower floors only by the headers that hold parameter types, and the one
    // function that writes a file whole
    {"app/project",
     {"engine/core", "engine/compute/wrap_mode.h", "engine/lighting/light_source.h",
      "engine/lighting/shading.h", "engine/mask/matte_reach.h", "engine/seam/seam.h",
      "engine/seam/seam_cost.h", "engine/synthesis/plane_amendment.h",
      "engine/temporal/temporal_mode.h", "engine/media/image_files.h",
      "engine/media/atomic_file.h"}},
    // 5
    {"app/session", {"engine", "gpu", "texture_db", "app/project"}},
    // 6
    {"ui", {"engine/core", "app/project", "app/session"}},
    // 7
    {"app/editor", {"engine", "gpu", "texture_db", "app/project", "app/session", "ui"}},
    {"app/cli", {"engine", "gpu", "texture_db", "app/project", "app/session"}},
    {"app/main.cpp", {"engine", "gpu", "texture_db", "ui", "app"}},
};

const std::vector<Library> kLibraries{
    {"OpenCV",
     {"opencv2/", "opencv4/"},
     {"engine/media", "engine/motion", "engine/mask", "engine/synthesis", "engine/seam",
      "engine/temporal", "engine/lighting", "engine/composite", "engine/metrics",
      "engine/baselines", "texture_db", "app/session"}},
    {"OpenImageIO", {"OpenImageIO/"}, {"engine/media"}},
    {"FFmpeg",
     {"libavcodec/", "libavformat/", "libavutil/", "libswscale/"},
     {"engine/media"},
     true},
    {"OpenColorIO", {"OpenColorIO/"}, {"engine/color"}},
    {"nlohmann-json",
     {"nlohmann/"},
     {"app", "texture_db", "app/project/json_codec.h", "app/session/measure_report.h",
      "app/session/report.h"}},
    {"CLI11", {"CLI/"}, {"app/cli", "app/main.cpp"}, true},
    {"CUDA",
     {"cuda", "cub/", "thrust/", "cufft", "cooperative_groups", "device_launch_parameters"},
     {"gpu"},
     true},
    {"FFTW",
     {"fftw3"},
     {"engine/compute", "engine/synthesis", "engine/metrics", "engine/synthesis/fftw_memory.h"}},
    {"SQLite", {"sqlite3"}, {"texture_db"}},
    {"Dear ImGui", {"imgui", "backends/imgui"}, {"ui", "app/editor"}, true},
    {"GLFW and OpenGL", {"GLFW/", "GL/", "EGL/", "glad/", "epoxy/"}, {"app/editor"}, true},
    {"X11", {"X11/"}, {"app/editor"}, true},
};

constexpr std::size_t kLongFileLines = 500;

struct SourceFile {
    std::string path, contents;
};

std::vector<SourceFile> source_files() {
    namespace fs = std::filesystem;
    const fs::path root = WEFT_SOURCE_DIR;
    std::vector<SourceFile> out;
    for (const char* folder : {"app", "engine", "gpu", "ui", "texture_db"}) {
        if (!fs::exists(root / folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            static const std::vector<std::string> kKinds{".h",   ".hpp", ".cuh",
                                                         ".cpp", ".cc",  ".cu"};
            const std::string kind = entry.path().extension().string();
            if (!entry.is_regular_file() ||
                std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end())
                continue;
            std::ifstream file(entry.path(), std::ios::binary);
            out.push_back({entry.path().lexically_relative(root).generic_string(),
                           std::string(std::istreambuf_iterator<char>(file), {})});
        }
    }
    std::sort(out.begin(), out.end(),
              [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return out;
}

TEST(Floors, EveryIncludePointsDownwards) {
    const std::vector<SourceFile> files = source_files();
    ASSERT_GT(files.size(), 20u) << "the source tree was not found in " << WEFT_SOURCE_DIR;
    for (const SourceFile& file : files)
        for (const std::string& broken :
             broken_rules(file.path, file.contents, kFloors, kLibraries))
            ADD_FAILURE() << broken;
}

TEST(Floors, LongFilesAreReported) {
    // A number to watch, not a rule.
    int long_files = 0;
    for (const SourceFile& file : source_files()) {
        const auto lines =
            static_cast<std::size_t>(std::count(file.contents.begin(), file.contents.end(), '\n'));
        if (lines <= kLongFileLines) continue;
        ++long_files;
        std::cout << file.path << ": " << lines << " lines\n";
    }
    RecordProperty("files_over_500_lines", long_files);
    std::cout << long_files << " files of more than " << kLongFileLines << " lines\n";
}

// ---- the tables ------------------------------------------------------------------------------

TEST(FloorTable, HasNoCycle) {
    // Repeatedly takes away a folder that uses only what was taken away before.
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
        Case{"app/session/a.cpp", "#include \"app/cli/b.h\"\n", "may not use"},
        Case{"app/main.cpp", "#include \"app/cli/cli.h\"\n", ""},
        Case{"ui/a.cpp", "#include \"engine/seam/seam.h\"\n", "may not use"},
        Case{"engine/seam/a.cpp", "#include <vector>\n#include <glm/vec2.hpp>\n", ""},
        Case{"engine/seam/a.cpp", "// #include \"app/x.h\" is not one\nauto s = \"#include\";\n",
             ""},
        Case{"engine/mask/a.cpp", "#include <opencv2/imgproc.hpp>\n", ""},
        Case{"engine/mask/a.h", "#include <opencv2/core.hpp>\n", "not be used in a header"},
        Case{"engine/mask/a.h", "#include \"opencv2/core.hpp\"\n", "not be used in a header"},
        Case{"engine/core/a.cpp", "#include <opencv2/core.hpp>\n", "OpenCV may not be used here"},
        Case{"app/project/a.cpp", "#include <opencv2/core.hpp>\n", "OpenCV may not be used here"},
        Case{"app/project/a.cpp", "#include <nlohmann/json.hpp>\n", ""},
        Case{"app/project/json_codec.h", "#include <nlohmann/json.hpp>\n", ""},
        Case{"app/project/edit.h", "#include <nlohmann/json_fwd.hpp>\n", "not be used in a header"},
        Case{"engine/metrics/a.cpp", "#include <nlohmann/json.hpp>\n",
             "nlohmann-json may not be used here"},
        Case{"engine/compute/a.cpp", "#include <cuda_runtime.h>\n", "CUDA may not be used here"},
        Case{"gpu/a.cu", "#include <cuda_runtime.h>\n", ""},
        Case{"app/session/a.cpp", "#include <CLI/CLI.hpp>\n", "CLI11 may not be used here"},
        Case{"ui/a.cpp", "#include <GLFW/glfw3.h>\n", "GLFW"}));

TEST(CheckerReports, EveryViolationOfAFile) {
    EXPECT_EQ(
        check("engine/core/a.h",
              "#include \"engine/seam/a.h\"\n#include <opencv2/core.hpp>\n#include \"gpu/b.h\"\n")
            .size(),
        3u);
}

}  // namespace
}  // namespace weft::architecture
