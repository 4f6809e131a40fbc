// Messages name settings by key (engine/core/setting.h), and each front end inserts its own terms.
// No string of the engine, the library, the session or the panels may contain a flag.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace weft::architecture {
namespace {

namespace fs = std::filesystem;

// Files that write command lines, and the tables that define the flags.
const std::vector<std::string> kAllowed{
    "app/composites/blender_composite.cpp",  // Blender's own
    "app/exchange/schemas.cpp",              // describe the output of --json
    "app/main.cpp",                          // parses the editor's command line
    "app/project/form_parameters.cpp",
    "app/project/look_parameters.cpp",
    "app/project/matte_parameters.cpp",
    "app/project/project_parameters.cpp",
    "app/project/region_parameters.cpp",
    "app/farm/farm_engines.cpp",           // writes a farm's scripts
    "app/jobs/job_worker.cpp",             // starts `weft render`
    "app/session/jobs/flat_painting.cpp",  // starts `weft flatten`
    "texture_db/sources/packages.cpp",     // runs apt-cache
};

std::vector<std::string> flags_in(const std::string& text) {
    static const std::regex kFlag(
        R"re("(?:[^"\n]*[ (',])?(--[a-z][a-z-]+|weft (?:look|region|texture|trust) [a-z]+)\b[^"\n]*")re");
    std::vector<std::string> out;
    for (std::sregex_iterator at(text.begin(), text.end(), kFlag), end; at != end; ++at)
        out.push_back((*at)[1]);
    return out;
}

std::string without_comments(const std::string& text) {
    return std::regex_replace(text, std::regex(R"((^|[ \n])//[^\n]*)"), "$1");
}

TEST(Messages, FlagsAreFoundInStrings) {
    EXPECT_THAT(flags_in(R"t(fail("No plate. Give --plate.");)t"), testing::ElementsAre("--plate"));
    EXPECT_THAT(flags_in(R"t("Choose one (--plane)")t"), testing::ElementsAre("--plane"));
    EXPECT_THAT(flags_in(R"t("--trust for one run")t"), testing::ElementsAre("--trust"));
    EXPECT_THAT(flags_in("if (--left == 0) say(\"a – b\");"), testing::IsEmpty());
}

// Placeholders for settings are written by by() only, which each front end replaces.
TEST(Messages, NoStringHoldsAPlaceholder) {
    const std::regex placeholder(R"re("[^"]*[^{"]\{[a-z_]+(\.[a-z_]+)+\}[^"]*")re");
    EXPECT_TRUE(std::regex_search(std::string(R"t("Draw it ({form.shape}).")t"), placeholder));
    EXPECT_FALSE(
        std::regex_search(std::string(R"t("a" + by({{kind.layer}}) + "b")t"), placeholder));
    const fs::path root(test::source_folder());
    for (const char* folder : {"engine", "texture_db", "gpu", "app", "ui"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string path = entry.path().lexically_relative(root).generic_string();
            if (!path.ends_with(".cpp") && !path.ends_with(".h")) continue;
            std::ifstream stream(entry.path());
            for (std::string line; std::getline(stream, line);) {
                if (line.find('{') == std::string::npos || line.find('"') > line.find("//"))
                    continue;
                EXPECT_FALSE(std::regex_search(line, placeholder)) << path << ": " << line;
            }
        }
    }
}

// Every setting that messages name is one that each front end is asked about.
TEST(Messages, EverySettingIsInTheListOfAll) {
    std::ifstream stream(fs::path(test::source_folder()) / "engine" / "core" / "setting.h");
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const std::size_t list = text.find("kAll{");
    ASSERT_NE(list, std::string::npos);
    const std::string all = text.substr(list, text.find("};", list) - list);
    const std::regex declared(R"re(\b(k[A-Z]\w*) =\s*")re");
    int count = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), declared), end; at != end; ++at) {
        ++count;
        EXPECT_TRUE(std::regex_search(all, std::regex("\\b" + (*at)[1].str() + "\\b"))) << (*at)[1];
    }
    EXPECT_GT(count, 60);
}

TEST(Messages, OnlyTheCommandLineNamesFlags) {
    const fs::path root(test::source_folder());
    std::vector<std::string> found;
    int files = 0;
    for (const char* folder : {"engine", "texture_db", "gpu", "app", "ui"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string path = entry.path().lexically_relative(root).generic_string();
            if (!path.ends_with(".cpp") && !path.ends_with(".h")) continue;
            if (path.starts_with("app/cli/") || path.starts_with("app/editor/") ||
                std::find(kAllowed.begin(), kAllowed.end(), path) != kAllowed.end())
                continue;
            std::ifstream stream(entry.path());
            const std::string text(std::istreambuf_iterator<char>(stream), {});
            ++files;
            for (const std::string& flag : flags_in(without_comments(text)))
                found.push_back(path + ": " + flag);
        }
    }
    EXPECT_GT(files, 300);
    EXPECT_THAT(found, testing::IsEmpty());
}

}  // namespace
}  // namespace weft::architecture
