#include "tests/cli/cli_fixture.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>

#include "engine/core/hash.h"
#include "engine/media/image_files.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

std::string numbered(int frame) {
    char text[16];
    std::snprintf(text, sizeof text, frame < 0 ? "-%04d" : "%04d", std::abs(frame));
    return text;
}

}  // namespace

void CliTest::SetUp() {
    std::string name = (fs::temp_directory_path() / "weft_cli_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    for (const char* part : {"tmp", "home"})
        fs::create_directory(folder_ / part);
    options_.folder = folder_;
    options_.environment = {{"TMPDIR", in("tmp")},
                            {"HOME", in("home")},
                            {"XDG_CACHE_HOME", in("home/cache")},
                            {"OCIO", ""}};
    put_picture("tile.png", pattern_picture({128, 128}, 5));
    put_picture("sample.png", pattern_picture({96, 96}, 7));
}

void CliTest::make_shot(int count, int first, const std::string& extension, PixelDepth depth,
                        const PlateEdit& edit) {
    for (const char* part : {"frames", "masks"})
        fs::create_directories(folder_ / part);
    for (int step = 0; step < count; ++step) {
        ImageF3 plate = card_plate(step);
        if (edit) edit(first + step, plate);
        put_picture("frames/" + numbered(first + step) + extension, plate, depth);
        put_matte("masks/" + numbered(first + step) + ".png", card_matte(step));
    }
}

Words with_options(Words words, const Words& more) {
    for (const std::string& word : more) {
        const auto at = std::find(words.begin(), words.end(), word);
        if (word.size() > 1 && word[0] == '-' && at != words.end() && word != "--matte")
            words.erase(at, at + 2);
    }
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

Words CliTest::replace(const Words& more) const {
    return with_options(
        {"replace", "--plate", "frames/####.png", "--matte", "masks/####.png", "--plane",
         "tile.png", "-o", "out/####.png", "--quality", "draft", "--backend", "cpu"},
        more);
}

Words CliTest::names(const std::string& folder) const {
    Words found;
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(folder_ / folder, missing))
        found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    return found;
}

std::map<std::string, std::string> CliTest::contents(const std::string& folder) const {
    std::map<std::string, std::string> all;
    for (const std::string& name : names(folder)) {
        if (fs::is_directory(folder_ / folder / name)) continue;
        const std::string whole = bytes(folder + "/" + name);
        Hasher hasher;
        hasher.bytes(whole.data(), whole.size());
        all[name] = hasher.finish().hex();
    }
    return all;
}

std::string CliTest::bytes(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void CliTest::put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
}

void CliTest::put_picture(const std::string& name, const ImageF3& image, PixelDepth depth) const {
    WriteOptions options;
    options.depth = depth;
    options.rule = WriteRule::own();
    const Status status = write_image(in(name), image, {}, options);
    ASSERT_TRUE(status) << status.error().text();
}

void CliTest::put_matte(const std::string& name, const Matte& matte) const {
    const Status status = write_matte(in(name), matte, WriteRule::own());
    ASSERT_TRUE(status) << status.error().text();
}

PlateFrame CliTest::picture(const std::string& name) const {
    auto read = read_image(in(name));
    EXPECT_TRUE(read) << name;
    return read ? std::move(*read) : PlateFrame{};
}

void expect_one_line(const std::string& text, const Words& parts) {
    EXPECT_THAT(text, ::testing::StartsWith("weft: "));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    for (const std::string& part : parts)
        EXPECT_THAT(text, ::testing::HasSubstr(part));
}

void expect_failure(const Outcome& outcome, int exit, const Words& parts) {
    EXPECT_EQ(outcome.exit, exit) << outcome.err;
    expect_one_line(outcome.err, parts);
}

void expect_success(const Outcome& outcome) {
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
}

}  // namespace weft::test
