// Which frames of an output are on disk.
#include "app/base/frames_on_disk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

class OnDisk : public ::testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    void write(const std::string& name) const { std::ofstream(folder / name) << "x"; }
    std::vector<int> looked_up(double now_s) {
        static_cast<void>(found.of(pattern(), now_s));
        while (found.busy()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            static_cast<void>(found.of(pattern(), now_s));
        }
        return found.of(pattern(), now_s);
    }
    [[nodiscard]] std::string pattern() const { return (folder / "a.####.png").string(); }

    fs::path folder = fs::path(::testing::TempDir()) / "weft_frames_on_disk";
    FramesOnDisk found;
};

TEST_F(OnDisk, AreThoseOfThePatternAndLookedUpAgain) {
    for (const char* name : {"a.0003.png", "a.0001.png", "b.0002.png", "a.0004.exr"})
        write(name);
    EXPECT_THAT(looked_up(0), ElementsAre(1, 3));
    write("a.0002.png");
    EXPECT_THAT(looked_up(1), ElementsAre(1, 3));
    EXPECT_THAT(looked_up(60), ElementsAre(1, 2, 3));
}

TEST_F(OnDisk, AreNoneOfAnotherPatternOrWithoutAFolder) {
    write("a.0001.png");
    EXPECT_THAT(looked_up(0), ElementsAre(1));
    EXPECT_THAT(found.of((folder / "none" / "####.png").string(), 0), IsEmpty());
    fs::remove_all(folder);
    EXPECT_THAT(looked_up(60), IsEmpty());
}

TEST(CountExisting, CountsWhatIsInBoth) {
    EXPECT_EQ(count_existing({1, 2, 3, 10}, {2, 10, 11}), 2);
    EXPECT_EQ(count_existing({}, {2}), 0);
}

}  // namespace
}  // namespace weft
