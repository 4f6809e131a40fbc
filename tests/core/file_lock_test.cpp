#include "engine/core/file_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

namespace weft {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;

class Locks : public testing::Test {
  protected:
    void SetUp() override {
        dir_ = fs::temp_directory_path() / ("weft_file_lock_" + std::to_string(getpid()));
        fs::create_directories(dir_);
        std::ofstream(file()) << "a";
    }
    void TearDown() override { fs::remove_all(dir_); }
    [[nodiscard]] std::string file() const { return (dir_ / "shot.weft").string(); }
    void replace() const {
        std::ofstream(dir_ / "new") << "b";
        fs::rename(dir_ / "new", file());
    }
    fs::path dir_;
};

TEST_F(Locks, OneWriterAtATimeAndTheNextSaysWhatToDo) {
    auto first = FileLock::take(file(), 0ms);
    ASSERT_TRUE(first);
    EXPECT_TRUE(first->held());
    const auto second = FileLock::take(file(), 30ms);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(second.error().text(), HasSubstr(file() + " is being written by another program"));
    EXPECT_THAT(second.error().text(), HasSubstr("try again"));
    { const FileLock ended = std::move(*first); }
    EXPECT_TRUE(FileLock::take(file(), 0ms)) << "free again";
    EXPECT_EQ(std::distance(fs::directory_iterator(dir_), fs::directory_iterator()), 1)
        << "nothing is left behind";
}

TEST_F(Locks, AFileThatWasReplacedIsLockedByItsNewSelf) {
    std::atomic<bool> waiting = false;
    bool held = false;
    auto first = FileLock::take(file(), 0ms);
    ASSERT_TRUE(first);
    std::thread writer([&] {
        waiting = true;
        auto next = FileLock::take(file(), 10s);
        held = next && next->held() && !FileLock::take(file(), 0ms);
    });
    while (!waiting)
        std::this_thread::yield();
    replace();
    { const FileLock ended = std::move(*first); }
    writer.join();
    EXPECT_TRUE(held) << "the waiting writer excludes those that open the new file";
}

TEST_F(Locks, ALinkIsLockedWithItsFile) {
    fs::create_symlink("shot.weft", dir_ / "link.weft");
    const auto lock = FileLock::take((dir_ / "link.weft").string(), 0ms);
    ASSERT_TRUE(lock);
    EXPECT_FALSE(FileLock::take(file(), 0ms));
}

TEST_F(Locks, ACrashFreesTheLock) {
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
        const auto lock = FileLock::take(file(), 0ms);
        const char said = lock && lock->held() ? 'y' : 'n';
        (void)!write(ready[1], &said, 1);
        pause();
        _exit(0);
    }
    char said = 0;
    ASSERT_EQ(read(ready[0], &said, 1), 1);
    EXPECT_EQ(said, 'y');
    EXPECT_FALSE(FileLock::take(file(), 0ms)) << "another process holds it";
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_TRUE(FileLock::take(file(), 0ms));
    close(ready[0]);
    close(ready[1]);
}

TEST_F(Locks, WhatIsNoFileExcludesNobody) {
    for (const std::string& path : {file() + ".none", dir_.string(), std::string("/dev/null")}) {
        const auto lock = FileLock::take(path, 0ms);
        ASSERT_TRUE(lock) << path;
        EXPECT_FALSE(lock->held()) << path;
    }
    ASSERT_EQ(mkfifo((dir_ / "pipe").c_str(), 0600), 0);
    EXPECT_FALSE(FileLock::take((dir_ / "pipe").string(), 0ms)->held()) << "and never waits";
}

TEST_F(Locks, AFileThatMayOnlyBeReadIsLockedToo) {
    fs::permissions(file(), fs::perms::owner_read);
    const auto lock = FileLock::take(file(), 0ms);
    ASSERT_TRUE(lock);
    EXPECT_TRUE(lock->held());
}

}  // namespace
}  // namespace weft
