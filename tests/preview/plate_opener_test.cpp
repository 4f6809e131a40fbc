#include "app/preview/plate_opener.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "engine/media/frame_writer.h"

namespace weft {
namespace {

class PlateOpenerTest : public testing::Test {
  protected:
    PlateOpenerTest() {
        std::filesystem::create_directories(folder_);
        for (const char* name : {"a.0001.png", "a.0002.png", "b.0001.png"})
            EXPECT_TRUE(write_image((folder_ / name).string(), ImageF3(32, 24, 0.5f), {}, {}));
    }
    ~PlateOpenerTest() override { std::filesystem::remove_all(folder_); }
    [[nodiscard]] Plate plate(const char* pattern) const {
        Plate out;
        out.path = (folder_ / pattern).string();
        return out;
    }
    Expected<OpenedPlate> wait() {
        for (int k = 0; k < 2000; ++k) {
            if (auto opened = opener_.take()) return std::move(*opened);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return fail(ErrorCode::kRenderFailed, "The plate was not opened in time.");
    }

    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() /
        ("weft_opener_" + std::to_string(std::hash<std::thread::id>()(std::this_thread::get_id())));
    PlateOpener opener_;
};

TEST_F(PlateOpenerTest, APlateIsOpenedOnce) {
    EXPECT_TRUE(opener_.open(plate("a.####.png")));
    EXPECT_TRUE(opener_.busy());
    const auto opened = wait();
    ASSERT_TRUE(opened) << opened.error().text();
    EXPECT_THAT(opened->reader->frames(), testing::ElementsAre(1, 2));
    EXPECT_EQ(opened->space, "srgb");
    EXPECT_FALSE(opener_.busy());
    EXPECT_FALSE(opener_.take());
    EXPECT_FALSE(opener_.open(plate("a.####.png"))) << "it is open already";
    EXPECT_FALSE(opener_.busy());
    opener_.forget();
    EXPECT_TRUE(opener_.open(plate("a.####.png")));
    EXPECT_TRUE(wait());
}

TEST_F(PlateOpenerTest, TheLatestPlateReplacesTheOneBefore) {
    opener_.open(plate("a.####.png"));
    opener_.open(plate("b.####.png"));
    const auto opened = wait();
    ASSERT_TRUE(opened) << opened.error().text();
    EXPECT_THAT(opened->reader->frames(), testing::ElementsAre(1));
    opener_.open(plate("a.####.png"));
    EXPECT_TRUE(opener_.open(Plate{}));
    EXPECT_FALSE(opener_.busy()) << "no plate, nothing to open";
}

TEST_F(PlateOpenerTest, AnErrorIsHandedOver) {
    opener_.open(plate("gone.####.png"));
    const auto opened = wait();
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().text(), testing::HasSubstr("gone."));
}

}  // namespace
}  // namespace weft
