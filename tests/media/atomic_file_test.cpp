// Whole files or none: full disks, unwritable folders, killed runs.

#include "engine/media/atomic_file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <thread>

#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using AtomicFile = MediaTest;

const WriteRule kOwn = WriteRule::own();

// Files of this process cannot grow beyond `bytes` while it lives, as on a disk with so much space.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before_);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int);
};

std::string text_at(const std::string& path) {
    const auto bytes = bytes_of(path);
    return {bytes.begin(), bytes.end()};
}

TEST_F(AtomicFile, ReplacesTheWholeFile) {
    ASSERT_TRUE(write_file_atomically(in("a.json"), std::string_view("a longer first text"), kOwn));
    ASSERT_TRUE(write_file_atomically(in("a.json"), std::string_view("second"), kOwn));
    EXPECT_EQ(text_at(in("a.json")), "second");
    EXPECT_THAT(names(), ElementsAre("a.json"));
}

TEST_F(AtomicFile, ReadersNeverSeeAPart) {
    const std::string a(300000, 'a'), b(200000, 'b');
    ASSERT_TRUE(write_file_atomically(in("x"), a, kOwn));
    std::thread writer([&] {
        for (int i = 0; i < 100; ++i)
            (void)write_file_atomically(in("x"), i % 2 ? a : b, kOwn);
    });
    int wrong = 0;
    for (int i = 0; i < 200; ++i) {
        const std::string seen = text_at(in("x"));
        wrong += seen != a && seen != b;
    }
    writer.join();
    EXPECT_EQ(wrong, 0);
}

TEST_F(AtomicFile, FullDiskLeavesNothingBehind) {
    const ImageF3 noise = random_codes({256, 256}, 255, 1);
    const FullDisk full(20000);
    for (const auto& [name, depth] : {std::pair{"a.png", PixelDepth::kU8},
                                      {"a.jpg", PixelDepth::kU8},
                                      {"a.tif", PixelDepth::kU8},
                                      {"a.exr", PixelDepth::kHalf},
                                      {"a.dpx", PixelDepth::kU8}}) {
        WriteOptions options;
        options.depth = depth;
        const Status status = write_image(in(name), noise, {}, options);
        ASSERT_FALSE(status) << name;
        EXPECT_EQ(status.error().code, ErrorCode::kNoSpace) << status.error().text();
        EXPECT_THAT(status.error().sentence(), HasSubstr(name));
        EXPECT_THAT(names(), IsEmpty()) << name;
    }
    const std::string text(30000, 'x');
    EXPECT_EQ(write_file_atomically(in("a.json"), text, kOwn).error().code, ErrorCode::kNoSpace);
    EXPECT_THAT(names(), IsEmpty());
}

TEST_F(AtomicFile, FullDiskKeepsTheOlderFile) {
    put_frame(in("a.png"), picture({16, 16}, 0));
    const auto before = bytes_of(in("a.png"));
    {
        const FullDisk full(20000);
        WriteOptions options;
        options.rule = kOwn;
        const Status status =
            write_image(in("a.png"), random_codes({256, 256}, 255, 1), {}, options);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().code, ErrorCode::kNoSpace);
    }
    EXPECT_TRUE(bytes_of(in("a.png")) == before);
    EXPECT_THAT(names(), ElementsAre("a.png"));
}

TEST_F(AtomicFile, UnwritablePlacesAreUnreadable) {
    const ImageF3 image = picture({16, 16}, 0);
    std::filesystem::create_directory(in("folder.png"));
    put_bytes(in("file"), {'x'}, 1);
    for (const char* name : {"none/a.png", "folder.png", "file/a.png"}) {
        const Status status = write_image(in(name), image, {}, {});
        ASSERT_FALSE(status) << name;
        EXPECT_EQ(status.error().code, ErrorCode::kUnreadable) << status.error().text();
        EXPECT_THAT(status.error().sentence(), HasSubstr(name));
    }
    EXPECT_THAT(names(), ElementsAre("file", "folder.png"));
}

TEST_F(AtomicFile, FolderWithoutPermissionIsUnreadable) {
    // Root may write anywhere, so the write happens in a child that has given up its rights.
    std::filesystem::permissions(folder_, std::filesystem::perms(0555));
    const pid_t child = fork();
    if (child == 0) {
        if (getuid() == 0 && setuid(65534) != 0) _exit(9);
        const Status status = write_file_atomically(in("a.json"), std::string_view("x"), kOwn);
        _exit(status ? 0 : exit_code(status.error().code));
    }
    int result = 0;
    waitpid(child, &result, 0);
    std::filesystem::permissions(folder_, std::filesystem::perms(0755));
    ASSERT_TRUE(WIFEXITED(result));
    EXPECT_EQ(WEXITSTATUS(result), exit_code(ErrorCode::kUnreadable));
    EXPECT_THAT(names(), IsEmpty());
}

TEST_F(AtomicFile, LongNamesFit) {
    const std::string name = std::string(250, 'n') + ".png";
    put_frame(in(name), picture({8, 8}, 0));
    EXPECT_THAT(names(), ElementsAre(name));
}

TEST_F(AtomicFile, WhatAKilledRunLeftIsRemoved) {
    ASSERT_TRUE(write_file_atomically(in("keep.png"), std::string_view("x"), kOwn));
    ASSERT_TRUE(write_file_atomically(in(".hidden.png"), std::string_view("x"), kOwn));
    const pid_t child = fork();
    if (child == 0) {
        auto temporary = TemporaryFile::create(in("frame.0001.png"), kOwn);
        raise(SIGKILL);
        _exit(temporary ? 0 : 1);
    }
    waitpid(child, nullptr, 0);
    ASSERT_EQ(names().size(), 3u);
    {
        const auto mine = TemporaryFile::create(in("frame.0002.png"), kOwn);
        ASSERT_TRUE(mine);
        EXPECT_TRUE(mine->name().ends_with(".png"));
        remove_stale_temporaries(in("frame.####.png"));
        EXPECT_TRUE(std::filesystem::exists(mine->name()));  // still being written
    }
    EXPECT_THAT(names(), ElementsAre(".hidden.png", "keep.png"));
}

}  // namespace
}  // namespace weft
