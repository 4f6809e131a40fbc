#include "app/base/file_watch.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>

#include "app/base/background.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// Many looks, also on a busy machine.
constexpr auto kSeen = 1500ms;

class FileWatching : public ::testing::Test {
  protected:
    void SetUp() override {
        keep_thread_priority();
        fs::create_directories(folder_);
        watch_ = std::make_unique<FileWatch>();
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string write(const std::string& name, const std::string& text) {
        std::string path = (folder_ / name).string();
        std::ofstream(path) << text;
        return path;
    }
    // Until something was written, or for `most`.
    std::vector<std::string> written(std::chrono::milliseconds most) {
        const auto end = std::chrono::steady_clock::now() + most;
        for (;;) {
            std::vector<std::string> now = watch_->take();
            if (!now.empty() || std::chrono::steady_clock::now() > end) return now;
            std::this_thread::sleep_for(5ms);
        }
    }

    fs::path folder_ = fs::temp_directory_path() / ("weft_watch_" + std::to_string(getpid()));
    std::unique_ptr<FileWatch> watch_;
};

TEST_F(FileWatching, TellsWhatWasWrittenAndNothingElse) {
    const std::string one = write("one", "a"), other = write("other", "a");
    watch_->follow({one, other});
    EXPECT_TRUE(written(kSeen).empty()) << "nothing was written since it was first seen";
    write("one", "bc");
    EXPECT_EQ(written(10s), std::vector{one});
    EXPECT_EQ(watch_->changes(), 1u);
    EXPECT_TRUE(written(kSeen).empty()) << "once";
}

// Krita and GIMP write another file and rename it, which may be gone for a moment.
TEST_F(FileWatching, WaitsForAFileThatIsReplaced) {
    const std::string path = write("one", "a");
    watch_->follow({path});
    EXPECT_TRUE(written(kSeen).empty());
    fs::remove(path);
    EXPECT_TRUE(written(kSeen).empty()) << "nothing to read";
    fs::rename(write("new", "bc"), path);
    EXPECT_EQ(written(10s), std::vector{path});
}

TEST_F(FileWatching, ForgetsWhatIsNotFollowed) {
    const std::string path = write("one", "a");
    watch_->follow({path});
    EXPECT_TRUE(written(kSeen).empty());
    watch_->follow({});
    write("one", "bc");
    EXPECT_TRUE(written(kSeen).empty());
}

}  // namespace
}  // namespace weft
