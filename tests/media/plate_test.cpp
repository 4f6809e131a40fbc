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

// GIMP saves layers as pages of their own size; the first is the background.
TEST_F(Plate, TiffWithPagesIsRefused) {
    const auto put_pages = [&](const std::string& path, int other_width, int kind = 0) {
        auto output = OIIO::ImageOutput::create(path);
        const std::vector<unsigned char> pixels(32 * 8 * 3, 99);
        for (const int width : {16, other_width}) {
            OIIO::ImageSpec spec(width, 8, 3, OIIO::TypeUInt8);
            if (kind != 0) spec.attribute("tiff:subfiletype", kind);
            ASSERT_TRUE(output->open(path, spec,
                                     width == 16 && output->spec().width == 0
                                         ? OIIO::ImageOutput::Create
                                         : OIIO::ImageOutput::AppendSubimage));
            ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, pixels.data()));
        }
        ASSERT_TRUE(output->close());
    };
    constexpr int kReduced = 1, kPage = 2;
    put_pages(in("layers.tif"), 16);
    put_pages(in("small_layer.tif"), 4, kPage);
    put_pages(in("preview_first.tif"), 32);
    for (const char* name : {"layers.tif", "small_layer.tif", "preview_first.tif"}) {
        const auto layers = open_plate(in(name), {});
        ASSERT_FALSE(layers) << name;
        EXPECT_EQ(layers.error().code, ErrorCode::kUnreadable);
        EXPECT_THAT(layers.error().sentence(), HasSubstr("pages or layers"));
    }
    put_pages(in("preview.tif"), 4);
    put_pages(in("marked.tif"), 4, kReduced);
    for (const char* name : {"preview.tif", "marked.tif"})
        EXPECT_EQ(opened(in(name))->size(), (Size{16, 8})) << name;
}

// A chunk of a RIFF file, padded to an even length.
std::vector<char> riff_chunk(const std::string& name, const std::vector<char>& data) {
    std::vector<char> out(name.begin(), name.end());
    for (int k = 0; k < 4; ++k)
        out.push_back(static_cast<char>(data.size() >> (8 * k) & 255));
    out.insert(out.end(), data.begin(), data.end());
    if (data.size() % 2 != 0) out.push_back(0);
    return out;
}

// The still WebP of 16×8 px `moments` times over.
std::vector<char> animated_webp(const std::vector<char>& still, int moments) {
    constexpr std::ptrdiff_t kHead = 12;  // "RIFF", length, "WEBP"
    std::vector<char> frame{0, 0, 0, 0, 0, 0, 15, 0, 0, 7, 0, 0, 40, 0, 0, 0};
    frame.insert(frame.end(), still.begin() + kHead, still.end());
    std::vector<char> body{'W', 'E', 'B', 'P'};
    const auto add = [&](const std::string& name, const std::vector<char>& data) {
        const std::vector<char> chunk = riff_chunk(name, data);
        body.insert(body.end(), chunk.begin(), chunk.end());
    };
    add("VP8X", {2, 0, 0, 0, 15, 0, 0, 7, 0, 0});
    add("ANIM", {0, 0, 0, 0, 0, 0});
    for (int k = 0; k < moments; ++k)
        add("ANMF", frame);
    return riff_chunk("RIFF", body);
}

// Readers give an animation's first picture.
TEST_F(Plate, AnimatedPicturesAreRefused) {
    const auto put_picture = [&](const std::string& path, int moments) {
        auto output = OIIO::ImageOutput::create(path);
        ASSERT_TRUE(output) << path;
        const std::vector<unsigned char> pixels(16 * 8 * 3, 99);
        const OIIO::ImageSpec spec(16, 8, 3, OIIO::TypeUInt8);
        for (int k = 0; k < moments; ++k) {
            ASSERT_TRUE(output->open(
                path, spec,
                k == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage));
            ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, pixels.data()));
        }
        ASSERT_TRUE(output->close());
    };
    put_picture(in("still.gif"), 1);
    put_picture(in("moving.gif"), 2);
    put_picture(in("still.webp"), 1);
    const auto webp = animated_webp(bytes_of(in("still.webp")), 2);
    put_bytes(in("moving.webp"), webp, webp.size());
    for (const char* still : {"still.gif", "still.webp"}) {
        const auto read = read_image(in(still));
        ASSERT_TRUE(read) << read.error().text();
        EXPECT_EQ(read->rgb.size(), (Size{16, 8})) << still;
    }
    for (const char* moving : {"moving.gif", "moving.webp"}) {
        const auto texture = read_image(in(moving));
        ASSERT_FALSE(texture) << moving;
        EXPECT_EQ(texture.error().code, ErrorCode::kUnreadable);
        EXPECT_THAT(texture.error().sentence(), HasSubstr("animation"));
    }
    const auto plate = open_plate(in("moving.webp"), {});
    ASSERT_FALSE(plate);
    EXPECT_THAT(plate.error().sentence(), HasSubstr("animation"));
}

// BMP's fourth byte is reserved; TGAs without an alpha often have 32 bits.
TEST_F(Plate, AnAlphaOfNothingButZeroIsNoneInBmpAndTga) {
    const auto put_pixels = [&](const std::string& name, const std::vector<unsigned char>& header,
                                unsigned char alpha) {
        std::vector<char> bytes(header.begin(), header.end());
        for (int k = 0; k < 8; ++k)
            for (const int code : {51, 102, 204, static_cast<int>(alpha)})
                bytes.push_back(static_cast<char>(code));
        put_bytes(in(name), bytes, bytes.size());
    };
    const std::vector<unsigned char> tga{0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 2, 0, 32, 0x28};
    const std::vector<unsigned char> bmp{
        'B', 'M', 86, 0, 0, 0, 0, 0,  0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 4, 0, 0, 0, 2, 0, 0, 0, 1,
        0,   32,  0,  0, 0, 0, 0, 32, 0, 0, 0,  0, 0, 0, 0,  0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    put_pixels("none.tga", tga, 0);
    put_pixels("none.bmp", bmp, 0);
    for (const char* name : {"none.tga", "none.bmp"}) {
        const PlateFrame frame = opened(in(name))->read(opened(in(name))->frames()[0]).value();
        EXPECT_TRUE(frame.alpha.empty()) << name;
        EXPECT_NEAR(frame.rgb.at(3, 1, 0), 204 / 255.0f, 1e-3) << name;
        EXPECT_NEAR(frame.rgb.at(0, 0, 2), 51 / 255.0f, 1e-3) << name;
    }
    put_pixels("half.tga", tga, 128);
    const auto half = opened(in("half.tga"));
    const PlateFrame frame = half->read(half->frames()[0]).value();
    ASSERT_FALSE(frame.alpha.empty());
    EXPECT_NEAR(frame.alpha.at(2, 1), 128 / 255.0f, 1e-3);
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
