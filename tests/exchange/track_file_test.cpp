#include "app/exchange/track_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace weft {
namespace {

class TrackFile : public ::testing::Test {
  protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    [[nodiscard]] Expected<CornerTrack> read(const std::string& text) const {
        const std::string path = (folder_ / "track").string();
        std::ofstream(path, std::ios::binary) << text;
        return read_corner_track(path, {{100, 50}, 1});
    }
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() /
        ("weft_track_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "_" +
         ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(TrackFile, ReadsJsonAndText) {
    const auto json = read(R"(  {"schema": "weft.track/1", "name": "kept by nobody", "frames": [
        {"frame": 3, "corners_px": [1, 2, 31.5, 2, 31, 22, 1, 22]},
        {"frame": 1, "corners_px": [0, 2, 30, 2, 30, 22, 0, 22]}]})");
    ASSERT_TRUE(json) << json.error().text();
    EXPECT_EQ(json->size(), 3u);
    EXPECT_DOUBLE_EQ(json->at(3)[1].x, 31.5);
    EXPECT_DOUBLE_EQ(json->at(2)[2].x, 30.5);
    const auto text = read("4 0 2 30 2 30 22 0 22");
    ASSERT_TRUE(text) << text.error().text();
    EXPECT_EQ(text->begin()->first, 4);
}

TEST_F(TrackFile, MayBeginWithAByteOrderMark) {
    const auto text = read(
        "\xef\xbb\xbf"
        "1 0 2 30 2 30 22 0 22\r\n2 1 2 31 2 31 22 1 22");
    ASSERT_TRUE(text) << text.error().text();
    EXPECT_EQ(text->size(), 2u);
    EXPECT_DOUBLE_EQ(text->at(2)[0].x, 1);
}

TEST_F(TrackFile, NamesTheFileAndWhatIsWrong) {
    for (
        const char* wrong :
        {"{", "{\"schema\": \"weft.track/2\", \"frames\": []}",
         R"({"schema": "weft.track/1", "frames": []})",
         R"({"schema": "weft.track/1", "frames": [3]})",
         R"({"schema": "weft.track/1", "frames": [{"frame": 1.5, "corners_px": [0,0,1,0,1,1,0,1]}]})",
         R"({"schema": "weft.track/1", "frames": [{"frame": 1, "corners_px": [0,0,1,0,1,1,0]}]})",
         R"({"schema": "weft.track/1", "frames": [{"frame": 1, "corners_px": [0,0,9,9,9,0,0,9]}]})",
         "1 2 3"}) {
        const auto track = read(wrong);
        ASSERT_FALSE(track) << wrong;
        EXPECT_EQ(track.error().code, ErrorCode::kUnreadable);
        EXPECT_NE(track.error().text().find("/track"), std::string::npos) << track.error().text();
    }
    EXPECT_FALSE(read_corner_track((folder_ / "none").string(), {{100, 50}, 1}));
}

}  // namespace
}  // namespace weft
