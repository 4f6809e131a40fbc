// packaging/libraries.json lists what is linked; docs/LICENCES.md, the package and the program
// agree with it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/cli/cli_fixture.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
}

Json table() {
    return Json::parse(
        text_of(std::filesystem::path(source_folder()) / "packaging/libraries.json"));
}

std::vector<std::string> found_in(const std::string& text, const std::string& pattern) {
    const std::regex wanted(pattern);
    std::vector<std::string> out;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), wanted);
         it != std::sregex_iterator(); ++it)
        out.push_back((*it)[1]);
    return out;
}

// The names in `key` of all entries.
std::set<std::string> names_in(const char* key) {
    std::set<std::string> out;
    for (const Json& library : table()) {
        for (const Json& name : library[key])
            out.insert(name.get<std::string>());
    }
    return out;
}

std::vector<std::string> needed_libraries(const std::string& program) {
    std::string told;
    FILE* pipe = popen(("readelf -d '" + program + "' 2>/dev/null").c_str(), "r");
    if (!pipe) return {};
    std::array<char, 4096> part{};
    while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe))
        told.append(part.data(), n);
    pclose(pipe);
    return found_in(told, R"(\(NEEDED\).*\[(.*)\])");
}

TEST(Licences, EveryEntryIsWhole) {
    for (const Json& library : table()) {
        for (const char* key : {"name", "licence", "linked", "used_for", "why", "obliges"})
            EXPECT_FALSE(library[key].get<std::string>().empty()) << library << " " << key;
        if (library["linked"].get<std::string>() == "compiled in") {
            EXPECT_FALSE(library["notice"].get<std::string>().empty())
                << library << " is part of the program: its notice is wanted";
        }
    }
}

TEST(Licences, EverySharedLibraryOfTheProgramIsInTheTable) {
    const auto needed = needed_libraries(weft_program());
    ASSERT_GT(needed.size(), 10u) << "readelf finds no libraries in " << weft_program();
    const auto known = names_in("libraries");
    for (const std::string& library : needed) {
        const bool there = std::any_of(known.begin(), known.end(), [&](const std::string& start) {
            return library.starts_with(start);
        });
        EXPECT_TRUE(there) << library << " is in no entry of packaging/libraries.json";
    }
}

TEST(Licences, EveryPackageThatCmakeFindsIsInTheTable) {
    const auto known = names_in("cmake");
    int found = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source_folder())) {
        const std::string path = entry.path().lexically_relative(source_folder()).generic_string();
        if (path.starts_with("build/") || path.starts_with("packaging/example/")) continue;
        if (!path.ends_with("CMakeLists.txt") && !path.ends_with(".cmake")) continue;
        for (const std::string& name : found_in(
                 text_of(entry.path()), R"((?:find_package|pkg_check_modules)\((\S+?)[\s)])")) {
            ++found;
            if (name == "PkgConfig" || name == "weft") continue;
            EXPECT_TRUE(known.count(name)) << path << " finds " << name
                                           << ", which is in no entry of packaging/libraries.json";
        }
    }
    EXPECT_GT(found, 15);
}

TEST(Licences, EveryDebianPackageOfALibraryIsInTheTable) {
    std::string known = " ";
    for (const Json& library : table())
        known += library["package"].get<std::string>() + " ";
    for (const char* list : {"debian-packages.txt", "debian-packages-test.txt"}) {
        std::istringstream lines(text_of(std::filesystem::path(source_folder()) / "cmake" / list));
        for (std::string line; std::getline(lines, line);) {
            const bool library = line.ends_with("-dev") || line.starts_with("fonts-");
            if (library) {
                EXPECT_THAT(known, HasSubstr(" " + line + " "));
            }
        }
    }
}

TEST(Licences, ThePageHasTheTable) {
    const std::string page = text_of(std::filesystem::path(source_folder()) / "docs/LICENCES.md");
    for (const Json& library : table()) {
        std::string row = "|";
        for (const char* key : {"name", "licence", "linked", "used_for", "why", "obliges"})
            row += " " + library[key].get<std::string>() + " |";
        EXPECT_THAT(page, HasSubstr(row + "\n"));
    }
}

class LicencesOf : public CliTest {};

TEST_F(LicencesOf, TheProgramNameTheLibrariesOfThisBuild) {
    const Outcome told = run({"--version", "--licences", "--json"});
    ASSERT_EQ(told.exit, 0) << told.err;
    const Json all = Json::parse(told.out);
    const std::string words = run({"--version", "--licences"}).out;
    const std::string copyright = text_of(copyright_file());
    std::set<std::string> names;
    for (const Json& library : all["libraries"]) {
        const std::string name = library["name"];
        names.insert(name);
        EXPECT_THAT(words, HasSubstr("\n" + name));
        EXPECT_THAT(copyright, HasSubstr("\n  " + name));
        EXPECT_THAT(copyright, HasSubstr(library["notice"].get<std::string>()));
    }
    for (const Json& library : table()) {
        const std::string name = library["name"], part = library["part"];
        if (part == "always") {
            EXPECT_EQ(names.count(name), 1u) << name;
        } else if (part == "tests") {
            EXPECT_EQ(names.count(name), 0u) << name;
        }
    }
    EXPECT_EQ(names.count("FFmpeg"), movie_library().empty() ? 0u : 1u);
    EXPECT_EQ(all["movies"].get<std::string>(), movie_library());
    EXPECT_THAT(
        run({"doctor"}).out,
        HasSubstr("movies: " + (movie_library().empty() ? "not in this build" : movie_library())));
    // The owner's choice is set in one place.
    const std::string licence = all["licence"];
    EXPECT_FALSE(licence.empty());
    EXPECT_THAT(words, HasSubstr("Licence of Weft: " + licence));
    EXPECT_THAT(copyright, HasSubstr("\n " + licence));
}

TEST_F(LicencesOf, TheProgramStandBesideTheVersionOnly) {
    EXPECT_THAT(run({"--version"}).out, Not(HasSubstr("OpenCV")));
    EXPECT_EQ(run({"--licences"}).exit, 2);
}

}  // namespace
}  // namespace weft::test
