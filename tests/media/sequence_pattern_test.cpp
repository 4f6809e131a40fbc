#include "engine/media/sequence_pattern.h"

#include <gmock/gmock.h>

#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

SequencePattern pattern(const std::string& text) {
    return SequencePattern::parse(text).value();
}

TEST(SequencePattern, WritesEachPlaceholder) {
    EXPECT_EQ(pattern("a/plate.####.exr").path_for(12), "a/plate.0012.exr");
    EXPECT_EQ(pattern("plate.@@@.exr").path_for(12), "plate.012.exr");
    EXPECT_EQ(pattern("plate.%05d.exr").path_for(12), "plate.00012.exr");
    EXPECT_EQ(pattern("plate.%d.exr").path_for(12), "plate.12.exr");
    EXPECT_EQ(pattern("plate_#.png").path_for(1001), "plate_1001.png");
    EXPECT_EQ(pattern("plate.####.exr").path_for(123456), "plate.123456.exr");
}

TEST(SequencePattern, SignComesBeforeThePadding) {
    EXPECT_EQ(pattern("p.####.exr").path_for(-12), "p.-0012.exr");
    EXPECT_EQ(pattern("p.%04d.exr").path_for(-12), "p.-012.exr");  // as C's printf
    EXPECT_EQ(pattern("p.%04d.exr").frame_of("p.-012.exr"), -12);
    EXPECT_EQ(pattern("p.%04d.exr").frame_of("p.-0012.exr"), std::nullopt);
    EXPECT_EQ(pattern("p.####.exr").frame_of("p.-0012.exr"), -12);
    EXPECT_EQ(pattern("p.%d.exr").path_for(-2147483647 - 1), "p.-2147483648.exr");
}

TEST(SequencePattern, ReadsOnlyWhatItWouldWrite) {
    const SequencePattern p = pattern("x/p.####.png");
    EXPECT_EQ(p.frame_of("x/p.0007.png"), 7);
    EXPECT_EQ(p.frame_of("x/p.12345.png"), 12345);
    for (const char* other :
         {"x/p.007.png", "x/p.00007.png", "x/p.-000.png", "x/p.-0000.png", "x/p.+007.png",
          "x/p.00a7.png", "x/q.0007.png", "x/p.0007.jpg", "x/p..png", "x/p.99999999999.png",
          "x/p.100000001.png", "x/p.-2147483648.png", "p.0007.png"}) {
        EXPECT_FALSE(p.frame_of(other)) << other;
    }
}

TEST(SequencePattern, NameWithoutANumberIsSingle) {
    const SequencePattern p = pattern("a/plate.exr");
    EXPECT_TRUE(p.is_single());
    EXPECT_EQ(p.path_for(7), "a/plate.exr");
    EXPECT_TRUE(pattern("100%.png").is_single());
    EXPECT_TRUE(pattern("plate.%4d.png").is_single());
}

TEST(SequencePattern, RefusesTwoNumbersAndNumbersInFolders) {
    for (const char* text : {"a.##.@@.png", "a.####.%d.png", "a.##x##.png"}) {
        const auto p = SequencePattern::parse(text);
        ASSERT_FALSE(p) << text;
        EXPECT_EQ(p.error().code, ErrorCode::kUsage);
        EXPECT_THAT(p.error().sentence(), HasSubstr("more than one"));
    }
    EXPECT_EQ(SequencePattern::parse("shot_##/a.png").error().code, ErrorCode::kUsage);
    EXPECT_EQ(SequencePattern::parse("%03d/a.####.png").error().code, ErrorCode::kUsage);
    EXPECT_EQ(SequencePattern::parse("folder/").error().code, ErrorCode::kUsage);
    EXPECT_TRUE(SequencePattern::parse("take#1/me@host/a.####.png"));
}

TEST(SequencePattern, ASingleCharacterBesideANumberIsPartOfTheName) {
    EXPECT_EQ(pattern("take#2.####.png").path_for(7), "take#2.0007.png");
    EXPECT_EQ(pattern("logo@2x.%03d.png").path_for(7), "logo@2x.007.png");
    EXPECT_EQ(pattern("a#.png").path_for(7), "a7.png");
    EXPECT_FALSE(SequencePattern::parse("a#b@.png"));
}

using SequenceFolder = MediaTest;

TEST_F(SequenceFolder, AFileOfTheVeryNameIsThatFile) {
    for (const char* name : {"logo@2x.png", "take#2.png"}) {
        EXPECT_FALSE(pattern(in(name)).is_single()) << name;
        put_frame(in(name), ImageF3(2, 2), PixelDepth::kU8);
        EXPECT_TRUE(pattern(in(name)).is_single()) << name;
        EXPECT_EQ(pattern(in(name)).path_for(7), in(name));
    }
}

TEST_F(SequenceFolder, ListsAscending) {
    for (const char* name : {"p.0010.png", "p.0002.png", "p.-0003.png", "p.12345.png", "p.002.png",
                             "p.0002.jpg", "other.0004.png"}) {
        put_bytes(in(name), {'x'}, 1);
    }
    EXPECT_THAT(pattern(in("p.####.png")).list_frames().value(), ElementsAre(-3, 2, 10, 12345));
    EXPECT_THAT(pattern(in("p.%d.png")).list_frames().value(), ElementsAre(12345));
}

// Frames before 0 in the other spelling are not left out without a word.
TEST_F(SequenceFolder, NegativeFramesAreReadAsTheyAreWritten) {
    for (const char* name : {"p.-002.png", "p.-001.png", "p.0000.png", "p.0001.png"})
        put_bytes(in(name), {'x'}, 1);
    EXPECT_THAT(pattern(in("p.%04d.png")).list_frames().value(), ElementsAre(-2, -1, 0, 1));
    const auto hashes = pattern(in("p.####.png")).list_frames();
    ASSERT_FALSE(hashes);
    EXPECT_EQ(hashes.error().code, ErrorCode::kUsage);
    EXPECT_THAT(hashes.error().sentence(), HasSubstr("Write %04d"));

    put_bytes(in("q.-0002.png"), {'x'}, 1);
    EXPECT_THAT(pattern(in("q.####.png")).list_frames().value(), ElementsAre(-2));
    const auto printf_style = pattern(in("q.%04d.png")).list_frames();
    ASSERT_FALSE(printf_style);
    EXPECT_THAT(printf_style.error().sentence(), HasSubstr("Write ####"));
}

// Nor are frames whose files are padded otherwise; another sequence further off is.
TEST_F(SequenceFolder, FramesOfAnotherPaddingAreNotLeftOutWithoutAWord) {
    for (const char* name : {"p.1.png", "p.2.png", "p.003.png", "p.1001.png"})
        put_bytes(in(name), {'x'}, 1);
    const auto mixed = pattern(in("p.#.png")).list_frames();
    ASSERT_FALSE(mixed);
    EXPECT_EQ(mixed.error().code, ErrorCode::kUsage);
    EXPECT_THAT(mixed.error().sentence(), HasSubstr("p.003.png is frame 3"));
    EXPECT_THAT(mixed.error().sentence(), HasSubstr("same padding"));
    put_bytes(in("p.3.png"), {'x'}, 1);
    EXPECT_THAT(pattern(in("p.#.png")).list_frames().value(), ElementsAre(1, 2, 3, 1001));
    EXPECT_THAT(pattern(in("p.####.png")).list_frames().value(), ElementsAre(1001));
}

TEST_F(SequenceFolder, MissingFolderIsUnreadable) {
    const auto frames = pattern(in("none/p.####.png")).list_frames();
    ASSERT_FALSE(frames);
    EXPECT_EQ(frames.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(frames.error().sentence(), HasSubstr("none"));
}

}  // namespace
}  // namespace weft
