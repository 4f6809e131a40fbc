// Opening plates: patterns, folders, single pictures, and what is wrong with them.

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <thread>

#include "engine/media/frame_reader.h"
#include "engine/media/image_files.h"
#include "engine/media/movies.h"
#include "tests/media/media_fixture.h"
#include "tests/support/places.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Plate = MediaTest;

std::shared_ptr<const FrameReader> opened(const std::string& path) {
    auto plate = open_plate(path, {});
    EXPECT_TRUE(plate) << plate.error().text();
    return plate.value();
}

TEST_F(Plate, ReadsTheFramesOfAPattern) {
    for (const int f : {8, 9, 11})
        put_frame(in("p." + std::to_string(f) + ".png"), picture({40, 30}, f));
    const auto plate = opened(in("p.%d.png"));
    EXPECT_THAT(plate->frames(), ElementsAre(8, 9, 11));
    EXPECT_EQ(plate->size(), (Size{40, 30}));
    EXPECT_EQ(plate->depth(), PixelDepth::kU8);
    EXPECT_EQ(plate->fps(), 0);
    EXPECT_TRUE(plate->display_encoded());
    EXPECT_EQ(plate->path_of(9), in("p.9.png"));
    EXPECT_EQ(plate->read(11).value().rgb, picture({40, 30}, 11));
}

TEST_F(Plate, AbsentFrameIsMissingAndNamed) {
    for (const int f : {1042, 1044})
        put_frame(in("p." + std::to_string(f) + ".png"), picture({8, 8}, f));
    const auto plate = opened(in("p.####.png"));
    for (const auto& error : {plate->read(1043).error(), plate->stamp(1043).error()}) {
        EXPECT_EQ(error.code, ErrorCode::kMissingFrames);
        EXPECT_THAT(error.sentence(), HasSubstr("Frame 1043 is missing in"));
        EXPECT_THAT(error.sentence(), HasSubstr("p.1043.png"));
    }
    std::filesystem::remove(in("p.1044.png"));
    EXPECT_EQ(plate->read(1044).error().code, ErrorCode::kMissingFrames);
}

TEST_F(Plate, NoFrameAtAllIsMissing) {
    EXPECT_EQ(open_plate(in("p.####.png"), {}).error().code, ErrorCode::kMissingFrames);
    EXPECT_EQ(open_plate(in("none/p.####.png"), {}).error().code, ErrorCode::kMissingFrames);
    EXPECT_EQ(open_plate(in("p.png"), {}).error().code, ErrorCode::kMissingFrames);
    EXPECT_EQ(open_plate(in("p.mp4"), {}).error().code, ErrorCode::kMissingFrames);
    EXPECT_EQ(open_plate(in("p.##.##.png"), {}).error().code, ErrorCode::kUsage);
}

TEST_F(Plate, OtherSizeIsUnreadableWithBothSizes) {
    put_frame(in("p.1.png"), picture({40, 30}, 1));
    put_frame(in("p.2.png"), picture({40, 31}, 2));
    const auto frame = opened(in("p.#.png"))->read(2);
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(frame.error().sentence(), HasSubstr("p.2.png"));
    EXPECT_THAT(frame.error().sentence(), HasSubstr("40x31"));
    EXPECT_THAT(frame.error().sentence(), HasSubstr("40x30"));
}

TEST_F(Plate, FolderWithOneSequenceIsThatSequence) {
    for (const char* name : {"shot-0001.png", "shot-0002.png", "thumb2.png", "notes3.txt"}) {
        put_frame(in("x.png"), picture({8, 8}, 0));
        std::filesystem::rename(in("x.png"), in(name));
    }
    const auto plate = opened(folder_.string());
    EXPECT_THAT(plate->frames(), ElementsAre(1, 2));
    EXPECT_EQ(plate->path_of(2), in("shot-0002.png"));
}

TEST_F(Plate, FolderNumbersMayBeNegativeOrUnpadded) {
    for (const char* name : {"p.-2.png", "p.8.png", "p.10.png"})
        put_frame(in(name), picture({8, 8}, 0));
    EXPECT_THAT(opened(folder_.string())->frames(), ElementsAre(-2, 8, 10));
}

TEST_F(Plate, FolderWithSeveralSequencesListsThem) {
    for (const char* name : {"a.01.png", "a.02.png", "b.01.png", "b.02.png"}) {
        put_frame(in(name), picture({8, 8}, 0));
    }
    const auto plate = open_plate(folder_.string(), {});
    ASSERT_FALSE(plate);
    EXPECT_EQ(plate.error().code, ErrorCode::kUsage);
    EXPECT_THAT(plate.error().sentence(), HasSubstr("a.##.png"));
    EXPECT_THAT(plate.error().sentence(), HasSubstr("b.##.png"));
    std::filesystem::create_directory(in("empty"));
    EXPECT_EQ(open_plate(in("empty"), {}).error().code, ErrorCode::kMissingFrames);
}

TEST_F(Plate, TheFrameNumberOfAFolderNeedNotBeTheLast) {
    for (const char* name : {"sh010_v002_0001_4k.png", "sh010_v002_0002_4k.png"})
        put_frame(in(name), picture({8, 8}, 0));
    EXPECT_THAT(opened(folder_.string())->frames(), ElementsAre(1, 2));
}

// Krita and GIMP save layers as pages; the first is the background.
TEST_F(Plate, TiffWithPagesOfOneSizeIsRefused) {
    const auto put_pages = [&](const std::string& path, int other_width) {
        auto output = OIIO::ImageOutput::create(path);
        const std::vector<unsigned char> pixels(16 * 8 * 3, 99);
        for (const int width : {16, other_width}) {
            const OIIO::ImageSpec spec(width, 8, 3, OIIO::TypeUInt8);
            ASSERT_TRUE(output->open(path, spec,
                                     width == 16 && output->spec().width == 0
                                         ? OIIO::ImageOutput::Create
                                         : OIIO::ImageOutput::AppendSubimage));
            ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, pixels.data()));
        }
        ASSERT_TRUE(output->close());
    };
    put_pages(in("layers.tif"), 16);
    const auto layers = open_plate(in("layers.tif"), {});
    ASSERT_FALSE(layers);
    EXPECT_EQ(layers.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(layers.error().sentence(), HasSubstr("pages or layers"));
    put_pages(in("preview.tif"), 4);
    EXPECT_EQ(opened(in("preview.tif"))->size(), (Size{16, 8}));
}

TEST_F(Plate, SinglePictureIsAPlateOfOneFrame) {
    put_frame(in("still_0012.png"), picture({8, 8}, 0));
    put_frame(in("logo@x.png"), picture({8, 8}, 0));
    EXPECT_THAT(opened(in("still_0012.png"))->frames(), ElementsAre(12));
    EXPECT_THAT(opened(in("logo@x.png"))->frames(), ElementsAre(1001));
    EXPECT_EQ(opened(in("still_0012.png"))->read(13).error().code, ErrorCode::kMissingFrames);
}

TEST_F(Plate, FileThatIsNoPlateIsUnreadable) {
    put_bytes(in("a.txt"), {'h', 'i'}, 2);
    put_bytes(in("b.0001.png"), {'h', 'i'}, 2);
    put_bytes(in("c.0001.png"), {}, 0);
    put_bytes(in("d.mp4"), {'h', 'i'}, 2);
    std::vector<const char*> names{"a.txt", "b.####.png", "c.####.png"};
    if (!movie_library().empty()) names.push_back("d.mp4");
    for (const char* name : names) {
        const auto plate = open_plate(in(name), {});
        ASSERT_FALSE(plate) << name;
        EXPECT_EQ(plate.error().code, ErrorCode::kUnreadable) << plate.error().text();
    }
}

TEST_F(Plate, StampFollowsTheFile) {
    put_frame(in("p.1.png"), picture({8, 8}, 1));
    put_frame(in("p.2.png"), picture({8, 8}, 1));
    const auto plate = opened(in("p.#.png"));
    const Hash128 before = plate->stamp(1).value();
    EXPECT_EQ(before, plate->stamp(1).value());
    EXPECT_NE(before, plate->stamp(2).value());
    const auto time = std::filesystem::last_write_time(in("p.1.png"));
    std::filesystem::last_write_time(in("p.1.png"), time + std::chrono::nanoseconds(1000));
    EXPECT_NE(before, plate->stamp(1).value());
}

TEST_F(Plate, GreyStandsInAllChannels) {
    ASSERT_TRUE(write_matte(in("g.png"), Matte(5, 4, 51)));
    const PlateFrame frame = read_image(in("g.png")).value();
    EXPECT_EQ(frame.rgb, ImageF3(5, 4, 0.2f));
    EXPECT_TRUE(frame.alpha.empty());
}

TEST_F(Plate, ReadsOnSeveralThreads) {
    for (int f = 1; f <= 6; ++f)
        put_frame(in("p." + std::to_string(f) + ".png"), picture({64, 48}, f));
    const auto plate = opened(in("p.#.png"));
    std::vector<int> wrong(4, 0);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < wrong.size(); ++t) {
        threads.emplace_back([&, t] {
            for (int f = 1; f <= 6; ++f) {
                const auto frame = plate->read(f);
                wrong[t] += !frame || !(frame->rgb == picture({64, 48}, f));
            }
        });
    }
    for (auto& thread : threads)
        thread.join();
    EXPECT_THAT(wrong, ElementsAre(0, 0, 0, 0));
}

TEST(PlateData, ReadsRealClips) {
    const std::string clip = test::shared_data_folder() + "/sequences/davis_blackswan/frames";
    if (!std::filesystem::exists(clip)) GTEST_SKIP() << "no evaluation data";
    const auto plate = open_plate(clip, {}).value();
    EXPECT_EQ(plate->frames().size(), 50u);
    EXPECT_EQ(plate->size(), (Size{854, 480}));
    EXPECT_TRUE(plate->read(plate->frames().back()));
}

}  // namespace
}  // namespace weft
