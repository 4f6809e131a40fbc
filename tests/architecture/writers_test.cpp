// Every file is written through engine/media/atomic_file.h, which applies the WriteRule. No other
// source opens files for writing, except those listed here with a reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "tests/support/places.h"

namespace weft::architecture {
namespace {

namespace fs = std::filesystem;

struct AllowedCall {
    std::string path, call, reason;
};

const std::vector<AllowedCall> kAllowedCalls{
    {"engine/media/atomic_file.cpp", "open for writing", "the one door"},
    {"engine/media/atomic_file.cpp", "rename", "the one door"},
    {"engine/media/atomic_file.cpp", "link", "the one door, on disks without RENAME_NOREPLACE"},
    {"engine/media/atomic_file.cpp", "copy_file", "onto a TemporaryFile"},
    {"engine/media/encode.cpp", "ImageOutput", "into memory, or onto a TemporaryFile"},
    {"engine/media/exr_frame.cpp", "ImageOutput", "into memory, or onto a TemporaryFile"},
    {"engine/media/movie_writer.cpp", "avio_open", "onto a TemporaryFile"},
    {"engine/core/file_lock.cpp", "open for writing",
     "network file systems lock only what is open for writing; writes nothing"},
    {"texture_db/catalogue/database.cpp", "sqlite",
     "the texture library, which SQLite keeps whole"},
    {"engine/core/child_process.cpp", "open for writing",
     "the streams of a child process, to files that its caller names"},
    {"app/base/detached_process.cpp", "open for writing",
     "the streams of a child process, in Weft's own folder"},
    {"app/cache/analysis_cache.cpp", "rename",
     "a whole folder of the cache, to a name that is free"},
};

// Skips files without these words, because std::regex is slow.
struct Pattern {
    std::string call;
    std::vector<std::string> words;
    std::regex text;
};

const std::vector<Pattern>& patterns() {
    static const std::vector<Pattern> list{
        {"ofstream",
         {"ofstream", "filebuf", "std::fstream"},
         std::regex(R"(\b(basic_)?(ofstream|filebuf)\b|\bstd::fstream\b)")},
        {"fopen",
         {"fopen", "fdopen", "freopen"},
         std::regex(R"(\bf(d|re)?open\s*\([^;]*"[^"]*[wa+][^"]*"\s*[,)])")},
        {"open for writing",
         {"O_", "creat"},
         std::regex(R"(\bO_(WRONLY|RDWR|CREAT|TRUNC|APPEND)\b|\bcreat\s*\()")},
        {"ImageOutput",
         {"ImageOutput", "ImageBuf"},
         std::regex(R"(\bImageOutput::create\b|\bImageBuf\b)")},
        {"avio_open", {"avio_open"}, std::regex(R"(\bavio_open2?\s*\()")},
        {"rename", {"rename"}, std::regex(R"(::rename(at2?)?\s*\()")},
        {"link",
         {"link"},
         std::regex(R"(\b(sym)?linkat\s*\(|::(sym)?link\s*\(|\bcreate_\w*link\s*\()")},
        {"copy_file", {"copy"}, std::regex(R"(\bcopy_file\s*\(|\bfs::copy\s*\()")},
        {"imwrite",
         {"imwrite", "VideoWriter", "FileStorage"},
         std::regex(R"(\bimwrite(multi)?\s*\(|\bVideoWriter\b|\bFileStorage\b)")},
        {"sqlite", {"sqlite3_open"}, std::regex(R"(\bsqlite3_open(_v2)?\s*\()")},
        {"mktemp", {"temp(", "tmpfile"}, std::regex(R"(\bmk(s|os|d)?temp\s*\(|\btmpfile\s*\()")},
    };
    return list;
}

// Removes comments, so that text about a call is not taken for a call.
std::string without_line_comments(const std::string& text) {
    std::string out;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        out += line.substr(0, line.find("//")) + "\n";
    return out;
}

std::vector<std::string> calls_in(const std::string& text) {
    std::vector<std::string> found;
    const std::string code = without_line_comments(text);
    const auto has = [&](const std::string& word) { return code.find(word) != std::string::npos; };
    for (const Pattern& pattern : patterns()) {
        if (std::any_of(pattern.words.begin(), pattern.words.end(), has) &&
            std::regex_search(code, pattern.text))
            found.push_back(pattern.call);
    }
    return found;
}

TEST(Writers, NoSourceWritesAFileByItself) {
    const fs::path root = test::source_folder();
    std::vector<std::string> used;
    int files = 0;
    for (const char* folder : {"app", "bench", "engine", "gpu", "ui", "texture_db"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string kind = entry.path().extension().string();
            if (kind != ".cpp" && kind != ".h" && kind != ".cu" && kind != ".cuh") continue;
            ++files;
            std::ifstream file(entry.path(), std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(file), {}};
            const std::string path = entry.path().lexically_relative(root).generic_string();
            for (const std::string& call : calls_in(text)) {
                const auto at = std::find_if(
                    kAllowedCalls.begin(), kAllowedCalls.end(),
                    [&](const AllowedCall& e) { return e.path == path && e.call == call; });
                EXPECT_TRUE(at != kAllowedCalls.end())
                    << path << " writes by itself (" << call
                    << "). Use engine/media/atomic_file.h, or give the reason here.";
                used.push_back(path + ": " + call);
            }
        }
    }
    EXPECT_GT(files, 200) << "the source tree was not found in " << root;
    for (const AllowedCall& e : kAllowedCalls)
        EXPECT_THAT(used, ::testing::Contains(e.path + ": " + e.call)) << "is not needed any more";
}

TEST(Writers, TheirCallsAreRecognised) {
    using ::testing::ElementsAre;
    using ::testing::IsEmpty;
    EXPECT_THAT(calls_in("std::ofstream out(path);"), ElementsAre("ofstream"));
    EXPECT_THAT(calls_in("std::fopen(path.c_str(), \"wb\")"), ElementsAre("fopen"));
    EXPECT_THAT(calls_in("std::fopen(path.c_str(), \"rb\")"), IsEmpty());
    EXPECT_THAT(calls_in("::open(p, O_RDONLY | O_CLOEXEC)"), IsEmpty());
    EXPECT_THAT(calls_in("::open(p, O_WRONLY)"), ElementsAre("open for writing"));
    EXPECT_THAT(calls_in("cv::imwrite(path, m);"), ElementsAre("imwrite"));
    EXPECT_THAT(calls_in("fs::rename(a, b); fs::copy_file(a, b);"),
                ElementsAre("rename", "copy_file"));
    EXPECT_THAT(calls_in("// like std::ofstream\nstd::ifstream in(p);"), IsEmpty());
}

}  // namespace
}  // namespace weft::architecture
