#include "engine/core/input_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace weft {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class InputFileTest : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "weft_input_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string in(const std::string& name) const { return (folder_ / name).string(); }
    std::string put(const std::string& name, const std::string& text) const {
        std::ofstream(in(name), std::ios::binary) << text;
        return in(name);
    }

    fs::path folder_;
};

void expect_refused(const std::string& path, const std::string& reason) {
    const auto checked = check_input_file(path, "The track");
    ASSERT_FALSE(checked) << path;
    EXPECT_EQ(checked.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(checked.error().sentence(),
                AllOf(HasSubstr("The track " + path), HasSubstr(reason)));
    EXPECT_EQ(read_file(path, "The track").error().sentence(), checked.error().sentence());
}

TEST_F(InputFileTest, ReadsWhatStandsInAFileOrBehindALink) {
    const std::string text("a\0b\n", 4);
    put("a", text);
    fs::create_symlink(in("a"), in("link"));
    for (const char* name : {"a", "link"}) {
        EXPECT_EQ(read_file(in(name), "The track").value(), text);
        EXPECT_EQ(check_input_file(in(name)).value().bytes, 4u);
    }
    EXPECT_EQ(read_file(put("empty", ""), "The track").value(), "");
}

TEST_F(InputFileTest, RefusesWhateverIsNoFile) {
    ASSERT_EQ(mkfifo(in("pipe").c_str(), 0600), 0);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    in("socket").copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(::bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    fs::create_symlink("nowhere", in("dangling"));
    fs::create_symlink("round", in("round"));

    expect_refused(in("pipe"), "a named pipe, not a file");
    expect_refused(in("socket"), "a socket, not a file");
    expect_refused(folder_.string(), "a folder, not a file");
    expect_refused("/dev/zero", "a device, not a file");
    expect_refused(in("missing"), "no such file");
    expect_refused(put("a", "") + "/b", "no such file");
    expect_refused(in("dangling"), "no such file");
    expect_refused(in("round"), "loop");
    ::close(socket);
}

TEST_F(InputFileTest, HoldsToItsLimit) {
    put("a", std::string(1000, 'x'));
    EXPECT_EQ(read_file(in("a"), "The track", 1000).value().size(), 1000u);
    const auto refused = read_file(in("a"), "The track", 999);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().sentence(), HasSubstr("larger than"));
    // A sparse file of 3 GB takes no room; nothing of it may be read.
    put("sparse", "");
    fs::resize_file(in("sparse"), std::uint64_t{3} << 30);
    EXPECT_THAT(read_file(in("sparse"), "The track").error().sentence(),
                HasSubstr("larger than 32 MB"));
}

// Files of the kernel say that they have 0 bytes, whatever they hold.
TEST_F(InputFileTest, ReadsOnWhereTheSizeSaysNothing) {
    EXPECT_FALSE(read_file("/proc/self/status", "The track").value().empty());
    EXPECT_FALSE(read_file("/proc/self/status", "The track", 10));
}

TEST_F(InputFileTest, GivesPartsAndStopsAtTheEnd) {
    const auto file = InputFile::open(put("a", "0123456789")).value();
    char part[8] = {};
    EXPECT_EQ(file.read_at(4, part, 3).value(), 3u);
    EXPECT_EQ(std::string(part, 3), "456");
    EXPECT_EQ(file.read_at(8, part, 8).value(), 2u);
    EXPECT_EQ(file.read_at(99, part, 8).value(), 0u);
}

TEST_F(InputFileTest, StampChangesWithTheFileAndHashWithItsContents) {
    put("a", "one");
    put("b", "one");
    EXPECT_EQ(hash_of_contents(in("a")).value(), hash_of_contents(in("b")).value());
    EXPECT_NE(check_input_file(in("a")).value(), check_input_file(in("b")).value());
    const FileStamp before = check_input_file(in("a")).value();
    EXPECT_EQ(check_input_file(in("a")).value(), before);
    put("a", "other");
    EXPECT_NE(check_input_file(in("a")).value(), before);
    EXPECT_NE(hash_of_contents(in("a")).value(), hash_of_contents(in("b")).value());
    EXPECT_FALSE(hash_of_contents("/dev/zero"));
}

}  // namespace
}  // namespace weft
