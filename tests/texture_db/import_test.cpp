#include "texture_db/sources/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/texture_db/scratch.h"
#include "texture_db/describe/near_duplicates.h"
#include "texture_db/describe/sample_codec.h"
#include "texture_db/sources/picture_choice.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

void write_png(const std::string& path, const ImageU8x3& image) {
    fs::create_directories(fs::path(path).parent_path());
    const auto bytes = encode_png(image);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

TEST(Import, TakesFoldersAsCategoriesAndOnlyColourMaps) {
    const Scratch scratch;
    write_png(scratch.at("in/walls/red_brick.png"), noise_picture(200, 1, 150, 70, 50));
    write_png(scratch.at("in/Wood051_1K/Wood051_1K_Color.png"),
              noise_picture(100, 2, 140, 100, 60));
    write_png(scratch.at("in/Wood051_1K/Wood051_1K_NormalGL.png"), noise_picture(100, 3));
    write_png(scratch.at("in/Wood051_1K/Wood051_1K_Roughness.png"), noise_picture(100, 4));
    std::ofstream(scratch.at("in/broken.png")) << "no picture";
    std::ofstream(scratch.at("in/readme.txt")) << "text";
    const auto library = open_or_die(scratch.at("a.db"));
    ImportOptions options;
    options.author = "Ada";
    options.licence = "CC0-1.0";
    options.tags = {"mine"};
    const auto report = import_pictures(*library, {scratch.at("in")}, options);
    ASSERT_TRUE(report) << report.error().text();
    EXPECT_EQ(report->pictures, 2);
    EXPECT_EQ(report->samples, 5) << "2 × 2 of the larger one, one of the other";
    EXPECT_EQ(report->skipped, 2);
    ASSERT_EQ(report->refused.size(), 1u);
    EXPECT_THAT(report->refused[0].first, testing::HasSubstr("broken.png"));
    SearchQuery query;
    query.categories = {"walls"};
    const auto walls = library->search(query);
    ASSERT_EQ(walls->total, 4);
    const auto info = library->info(walls->hits[0].id);
    EXPECT_EQ(info->material, "brick");
    EXPECT_EQ(info->author, "Ada");
    EXPECT_EQ(info->original_size, (Size{200, 200}));
    EXPECT_FALSE(info->original_in_file);
    EXPECT_EQ(library->original(info->id)->size(), (Size{200, 200})) << "read from where it lies";
    query = {};
    query.text = "mine wood";
    EXPECT_EQ(library->search(query)->total, 1);
}

TEST(Import, ASecondTimeTakesOnlyWhatChanged) {
    const Scratch scratch;
    write_png(scratch.at("in/a.png"), noise_picture(96, 1));
    write_png(scratch.at("in/b.png"), noise_picture(96, 2));
    const auto library = open_or_die(scratch.at("a.db"));
    EXPECT_EQ(import_pictures(*library, {scratch.at("in")}, {})->samples, 2);
    const auto again = import_pictures(*library, {scratch.at("in")}, {});
    EXPECT_EQ(again->skipped, 2);
    EXPECT_EQ(again->samples, 0);
    write_png(scratch.at("in/b.png"), noise_picture(96, 3, 90, 90, 90));
    EXPECT_EQ(import_pictures(*library, {scratch.at("in")}, {})->samples, 1);
}

TEST(Import, GoesOnAfterAnInterruption) {
    const Scratch scratch;
    for (std::uint64_t i = 0; i < 30; ++i)
        write_png(scratch.at("in/" + std::to_string(i) + ".png"), noise_picture(96, i));
    const auto library = open_or_die(scratch.at("a.db"));
    const CancelToken cancel;
    const auto stopped = import_pictures(*library, {scratch.at("in")}, {}, cancel,
                                         [&](const ProgressEvent&) { cancel.cancel(130); });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(exit_code(stopped.error().code), 130);
    const auto first = *library->size();
    EXPECT_GT(first, 0);
    EXPECT_LT(first, 30);
    const auto rest = import_pictures(*library, {scratch.at("in")}, {});
    EXPECT_EQ(rest->samples, 30 - first);
    EXPECT_EQ(library->size(), 30);
}

TEST(Import, AMissingPathIsAnError) {
    const Scratch scratch;
    const auto library = open_or_die(scratch.at("a.db"));
    const auto report = import_pictures(*library, {scratch.at("nothing")}, {});
    ASSERT_FALSE(report);
    EXPECT_THAT(report.error().sentence(), testing::HasSubstr("nothing"));
}

TEST(Import, KeepsOriginalsWhenAsked) {
    const Scratch scratch;
    write_png(scratch.at("in/a.png"), noise_picture(200, 1));
    const auto library = open_or_die(scratch.at("a.db"));
    ImportOptions options;
    options.keep_originals = true;
    ASSERT_TRUE(import_pictures(*library, {scratch.at("in")}, options));
    fs::remove_all(scratch.at("in"));
    const std::string id = library->search({})->hits[0].id;
    EXPECT_TRUE(library->info(id)->original_in_file);
    EXPECT_EQ(library->original(id)->size(), (Size{200, 200}));
}

TEST(Import, WatchesAFolder) {
    const Scratch scratch;
    fs::create_directories(scratch.at("in"));
    const auto library = open_or_die(scratch.at("a.db"));
    const CancelToken cancel;
    int rounds = 0;
    std::jthread artist([&] { write_png(scratch.at("in/new.png"), noise_picture(96, 1)); });
    const Status done = watch_folder(
        *library, scratch.at("in"), {}, cancel,
        [&](const ImportReport& r) {
            rounds += r.samples;
            if (r.samples > 0) cancel.cancel();
        },
        0.05);
    EXPECT_TRUE(done);
    EXPECT_EQ(rounds, 1);
}

TEST(Choice, LeavesOutWhatIsNoTexture) {
    const ChoiceRules rules;
    EXPECT_EQ(picture_fault(noise_picture(256, 1), rules), "");
    EXPECT_EQ(picture_fault(noise_picture(64, 1), rules), "too small");
    EXPECT_EQ(picture_fault(ImageU8x3(256, 256, 90), rules), "large flat parts");
    EXPECT_EQ(picture_fault(noise_picture(256, 2).size() == Size{256, 256} ? ImageU8x3(900, 150, 7)
                                                                           : ImageU8x3(),
                            rules),
              "a strip");
    ImageU8x3 framed = noise_picture(256, 3, 60, 60, 60, 20);
    for (int i = 0; i < 256; ++i)
        for (int d = 0; d < 4; ++d)
            for (int c = 0; c < 3; ++c)
                framed.at(i, d, c) = framed.at(i, 255 - d, c) = framed.at(d, i, c) =
                    framed.at(255 - d, i, c) = 250;
    EXPECT_EQ(picture_fault(framed, rules), "a border");
}

TEST(Choice, TakesSharpEvenSquaresThatDiffer) {
    ImageU8x3 picture = noise_picture(288, 1);
    // The middle is flat, and the top right repeats the top left.
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            for (int c = 0; c < 3; ++c) {
                picture.at(96 + x, 96 + y, c) = 120;
                picture.at(192 + x, y, c) = picture.at(x, y, c);
            }
        }
    }
    const auto chosen = choose_samples(picture, {});
    EXPECT_EQ(chosen.size(), 7u);
    for (const Recti& r : chosen)
        EXPECT_NE(r, (Recti{96, 96, 192, 192}));
    EXPECT_EQ(choose_samples(picture, {3, true}).size(), 3u);
}

TEST(Choice, LargePicturesAreHalved) {
    EXPECT_EQ(at_sample_scale(ImageU8x3(2048, 4096)).size(), (Size{512, 1024}));
    EXPECT_EQ(at_sample_scale(ImageU8x3(500, 700)).size(), (Size{500, 700}));
    EXPECT_EQ(at_sample_scale(ImageU8x3(48, 60)).size(), (Size{96, 120}));
}

TEST(NearDuplicatesOfPictures, AreKnownThoughScaledAndCompressed) {
    ImageU8x3 picture(256, 256);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x)
            for (int c = 0; c < 3; ++c)
                picture.at(x, y, c) = static_cast<std::uint8_t>(
                    (x / 16 * 37 + y / 16 * 91 + x / 16 * (y / 16) * 17) % 256);
    NearDuplicates seen;
    EXPECT_TRUE(seen.add_if_new(picture));
    EXPECT_FALSE(seen.add_if_new(resized(picture, {128, 128})));
    EXPECT_FALSE(seen.add_if_new(*decode_picture(encode_jpeg(picture))));
    EXPECT_TRUE(seen.add_if_new(noise_picture(256, 5)));
}

}  // namespace
}  // namespace weft
