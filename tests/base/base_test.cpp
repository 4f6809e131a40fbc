// app/base: path maps, screen images, folder lists, the frame clock.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "app/base/background.h"
#include "app/base/folder_lister.h"
#include "app/base/frame_clock.h"
#include "app/base/path_map.h"
#include "app/base/picture.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

TEST(PathMap, RootsMatchWholeFoldersAndTheFirstMatchWins) {
    EXPECT_FALSE(parse_root_map("/a"));
    EXPECT_FALSE(parse_root_map("=/a"));
    EXPECT_EQ(parse_root_map("/a=").error().code, ErrorCode::kUsage);
    const RootMap map = *parse_root_map("/proj/=/Volumes/proj");
    EXPECT_EQ(map.from, "/proj");
    Project project;
    project.plate.path = "/proj/shot/####.png";
    project.output.path = "/project/out/####.png";
    const Project mapped = with_mapped_roots(project, {map, {"/proj", "/never"}});
    EXPECT_EQ(mapped.plate.path, "/Volumes/proj/shot/####.png");
    EXPECT_EQ(mapped.output.path, "/project/out/####.png");
}

TEST(Picture, HalfsRoundTripWithinTheirPrecision) {
    for (const float value : {0.0f, 1.0f, -2.5f, 0.333251953125f, 65504.0f, 5.9604645e-8f})
        EXPECT_EQ(half_to_float(float_to_half(value)), value);
    EXPECT_EQ(half_to_float(float_to_half(1e9f)), 65504.0f);
}

TEST(Picture, EightBitsAreCodesAndLinearValuesAreEncodedForTheDisplay) {
    ImageF3 pixels(2, 1);
    pixels.pixel(0, 0)[0] = 0.5f;
    pixels.pixel(1, 0)[0] = 4.0f;
    const PicturePtr codes = make_picture(pixels, true, nullptr, nullptr);
    const PicturePtr linear = make_picture(pixels, false, nullptr, nullptr);
    EXPECT_NE(codes->id, linear->id);
    EXPECT_FLOAT_EQ(codes->at(0, 0).x, 128 / 255.0f);
    EXPECT_NEAR(codes->at(1, 0).x, 1.0f, 1e-6f);
    EXPECT_NEAR(linear->at(0, 0).x, 0.7354f, 0.002f);
    EXPECT_GT(linear->at(1, 0).x, 1.5f);
}

TEST(Picture, ShrinksByMeansUnderALongestSide) {
    ImageU8x3 picture(100, 50, 0);
    for (int y = 0; y < 50; ++y)
        for (int x = 50; x < 100; ++x)
            picture.pixel(x, y)[0] = 200;
    const ImageU8x3 small = shrink(picture.view(), 10);
    ASSERT_EQ(small.width(), 10);
    ASSERT_EQ(small.height(), 5);
    EXPECT_EQ(small.pixel(0, 2)[0], 0);
    EXPECT_EQ(small.pixel(9, 2)[0], 200);
}

TEST(FrameClock, SumsRepeatedPartsAndIsFreeWhenOff) {
    FrameClock clock(true);
    clock.begin();
    clock.enter("panels");
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    clock.enter("viewer");
    clock.enter("panels");
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    clock.end();
    ASSERT_EQ(clock.parts().size(), 2u);
    EXPECT_GE(clock.parts()[0].wall_ms, 6);
    EXPECT_LT(clock.parts()[0].processor_ms, clock.parts()[0].wall_ms);
    EXPECT_THAT(clock.text(), testing::HasSubstr(": panels "));
    FrameClock off(false);
    off.begin();
    off.enter("panels");
    off.end();
    EXPECT_TRUE(off.parts().empty());
}

TEST(Background, ReturnsTheResultOfTheWork) {
    EXPECT_EQ(in_background([] { return 42; }).get(), 42);
}

class Folder : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "weft_folder_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path folder_;
};

TEST_F(Folder, NumberedPicturesAreOneEntry) {
    fs::create_directory(folder_ / "textures");
    for (int frame = 1001; frame <= 1003; ++frame)
        std::ofstream(folder_ / ("plate." + std::to_string(frame) + ".exr")) << "x";
    std::ofstream(folder_ / "shot.weft") << "{}";
    std::ofstream(folder_ / "logo.png") << "x";
    const auto entries = list_folder(folder_.string());
    ASSERT_TRUE(entries) << entries.error().text();
    ASSERT_EQ(entries->size(), 4u);
    EXPECT_EQ((*entries)[0].kind, EntryKind::kFolder);
    const auto sequence = std::find_if(entries->begin(), entries->end(), [](const FolderEntry& e) {
        return e.kind == EntryKind::kSequence;
    });
    ASSERT_NE(sequence, entries->end());
    EXPECT_EQ(sequence->name, "plate.####.exr");
    EXPECT_THAT(sequence->detail, testing::HasSubstr("3 frames"));
    EXPECT_FALSE(list_folder((folder_ / "none").string()));
}

}  // namespace
}  // namespace weft
