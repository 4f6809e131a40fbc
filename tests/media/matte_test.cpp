#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <png.h>

#include <cstdio>
#include <cstring>

#include "engine/media/image_files.h"
#include "engine/media/matte_look.h"
#include "tests/media/media_fixture.h"
#include "tests/support/places.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MatteFile : public MediaTest {
  protected:
    template <class T>
    void put(const std::string& name, int channels, const std::vector<T>& samples,
             OIIO::TypeDesc type, std::vector<std::string> channel_names = {}) {
        OIIO::ImageSpec spec(static_cast<int>(samples.size()) / channels, 1, channels, type);
        if (!channel_names.empty()) spec.channelnames = channel_names;
        spec.attribute("oiio:UnassociatedAlpha", 1);
        auto output = OIIO::ImageOutput::create(in(name));
        ASSERT_TRUE(output->open(in(name), spec));
        ASSERT_TRUE(output->write_image(type, samples.data()));
        ASSERT_TRUE(output->close());
    }

    std::vector<int> read(const std::string& name, MatteSelect select, int width) {
        const auto matte = read_matte(in(name), select, {width, 1});
        EXPECT_TRUE(matte) << matte.error().text();
        if (!matte) return {};
        return {matte->data(), matte->data() + width};
    }
};

MatteSelect value(int v) {
    return {v, "", false};
}
MatteSelect channel(const char* c) {
    return {std::nullopt, c, false};
}

TEST_F(MatteFile, GreyIsCoverage) {
    put<std::uint8_t>("a.png", 1, {0, 1, 128, 255}, OIIO::TypeUInt8);
    EXPECT_THAT(read("a.png", {}, 4), ElementsAre(0, 1, 128, 255));
    EXPECT_THAT(read("a.png", {std::nullopt, "", true}, 4), ElementsAre(255, 254, 127, 0));
}

TEST_F(MatteFile, DeeperSamplesAreRounded) {
    put<std::uint16_t>("a.png", 1, {0, 128, 129, 32896, 65535}, OIIO::TypeUInt16);
    EXPECT_THAT(read("a.png", {}, 5), ElementsAre(0, 0, 1, 128, 255));
    put<float>("a.exr", 1, {-1.0f, 0.5f, 1.5f, NAN, 0.002f}, OIIO::TypeFloat, {"Y"});
    EXPECT_THAT(read("a.exr", {}, 5), ElementsAre(0, 128, 255, 0, 1));
}

// Cycles' IndexOB.
TEST_F(MatteFile, WholeNumbersInFloatsAreIds) {
    put<float>("ids.exr", 4, {1, 7, 0, 0, 0.5f, 0, 0, 2}, OIIO::TypeFloat,
               {"v.Combined.R", "v.Combined.G", "v.Combined.B", "v.IndexOB.X"});
    EXPECT_THAT(read("ids.exr", value(2), 2), ElementsAre(0, 255)) << "found beside the picture";
    MatteSelect named = value(0);
    named.channel = "v.IndexOB.X";
    EXPECT_THAT(read("ids.exr", named, 2), ElementsAre(255, 0));
    named.channel = "v.Combined.R";
    const auto fractions = read_matte(in("ids.exr"), named, {2, 1});
    ASSERT_FALSE(fractions);
    EXPECT_EQ(fractions.error().code, ErrorCode::kUsage);
    EXPECT_THAT(fractions.error().sentence(), HasSubstr("fractions"));
}

TEST_F(MatteFile, ChannelsAreChosen) {
    put<std::uint8_t>("a.png", 4, {10, 20, 30, 40, 50, 60, 70, 255}, OIIO::TypeUInt8);
    EXPECT_THAT(read("a.png", channel("R"), 2), ElementsAre(10, 50));
    EXPECT_THAT(read("a.png", channel("G"), 2), ElementsAre(20, 60));
    EXPECT_THAT(read("a.png", channel("B"), 2), ElementsAre(30, 70));
    EXPECT_THAT(read("a.png", channel("A"), 2), ElementsAre(40, 255));
    EXPECT_THAT(read("a.png", channel("Y"), 2),
                ElementsAre(19, 59));                         // 0.2126 R + 0.7152 G + 0.0722 B
    EXPECT_THAT(read("a.png", {}, 2), ElementsAre(40, 255));  // an alpha with something to say
}

// OpenImageIO names the two channels R and G.
TEST_F(MatteFile, GreyWithAlphaIsReadByAlpha) {
    put<std::uint8_t>("a.sgi", 2, {90, 0, 90, 128, 90, 255}, OIIO::TypeUInt8);
    EXPECT_THAT(read("a.sgi", {}, 3), ElementsAre(0, 128, 255));
    EXPECT_THAT(read("a.sgi", channel("Y"), 3), ElementsAre(90, 90, 90));
}

// The header of a PSD of 2 × 1 pixels, then nothing but raw samples.
std::string psd(int mode, int channels, const std::string& table, const std::string& samples) {
    const auto one_of = [](int value) { return std::string{'\0', static_cast<char>(value)}; };
    const std::string none(4, '\0');
    return "8BPS" + one_of(1) + std::string(6, '\0') + one_of(channels) + none.substr(2) +
           one_of(1) + none.substr(2) + one_of(2) + one_of(8) + one_of(mode) + none.substr(2) +
           std::string{static_cast<char>(table.size() >> 8), '\0'} + table + none + none +
           one_of(0) + samples;
}

TEST_F(MatteFile, PsdOfAModeThatWouldBeReadWrongIsRefused) {
    const auto put_psd = [&](const std::string& name, const std::string& bytes) {
        put_bytes(in(name), {bytes.begin(), bytes.end()}, bytes.size());
    };
    put_psd("grey.psd", psd(1, 1, {}, {'\0', '\x80'}));
    EXPECT_THAT(read("grey.psd", {}, 2), ElementsAre(0, 128));
    put_psd("indexed.psd", psd(2, 1, std::string(768, '\xff'), {'\0', '\1'}));
    put_psd("multichannel.psd", psd(7, 3, {}, std::string(6, '\x80')));
    put_psd("Lab.psd", psd(9, 3, {}, std::string(6, '\x80')));
    for (const std::string mode : {"indexed", "multichannel", "Lab"}) {
        const auto matte = read_matte(in(mode + ".psd"), {}, {2, 1});
        ASSERT_FALSE(matte) << mode;
        EXPECT_EQ(matte.error().code, ErrorCode::kUnreadable);
        EXPECT_THAT(matte.error().sentence(), HasSubstr("colour mode " + mode));
    }
}

TEST_F(MatteFile, OpaqueAlphaIsNoMatte) {
    put<std::uint8_t>("a.png", 4, {10, 10, 10, 255, 50, 50, 50, 255}, OIIO::TypeUInt8);
    EXPECT_THAT(read("a.png", {}, 2), ElementsAre(10, 50));
}

TEST_F(MatteFile, NamedExrChannel) {
    put<float>("a.exr", 4, {0, 0, 0, 1, 0, 0, 0, 0.2f}, OIIO::TypeFloat,
               {"R", "G", "B", "mask.fox"});
    EXPECT_THAT(read("a.exr", channel("mask.fox"), 2), ElementsAre(255, 51));
    const auto other = read_matte(in("a.exr"), channel("mask.dog"), {2, 1});
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(other.error().sentence(), HasSubstr("mask.fox"));
}

TEST_F(MatteFile, MissingChannelIsUnreadable) {
    put<std::uint8_t>("a.png", 3, {10, 20, 30}, OIIO::TypeUInt8);
    EXPECT_EQ(read_matte(in("a.png"), channel("A"), {1, 1}).error().code, ErrorCode::kUnreadable);
    EXPECT_EQ(read_matte(in("a.png"), channel("fox"), {1, 1}).error().code, ErrorCode::kUnreadable);
}

TEST_F(MatteFile, IdsAreComparedExactly) {
    put<std::uint8_t>("a.png", 1, {0, 1, 2, 1, 255}, OIIO::TypeUInt8);
    EXPECT_THAT(read("a.png", value(1), 5), ElementsAre(0, 255, 0, 255, 0));
    EXPECT_THAT(read("a.png", {1, "", true}, 5), ElementsAre(255, 0, 255, 0, 255));
    put<std::uint16_t>("b.png", 1, {300, 301, 44}, OIIO::TypeUInt16);
    EXPECT_THAT(read("b.png", value(300), 3), ElementsAre(255, 0, 0));
    put<std::uint8_t>("c.png", 3, {5, 7, 9, 6, 5, 5}, OIIO::TypeUInt8);
    EXPECT_THAT(read("c.png", value(5), 2), ElementsAre(255, 0));
    EXPECT_THAT(read("c.png", {5, "G", false}, 2), ElementsAre(0, 255));
    put<std::uint32_t>("d.exr", 1, {70000, 4}, OIIO::TypeUInt32, {"id"});
    EXPECT_THAT(read("d.exr", {70000, "id", false}, 2), ElementsAre(255, 0));
}

TEST_F(MatteFile, PaletteIdsAreIndices) {
    std::FILE* file = std::fopen(in("a.png").c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, 4, 1, 2, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const png_color palette[4] = {{0, 0, 0}, {128, 0, 0}, {0, 128, 0}, {255, 255, 255}};
    png_set_PLTE(png, info, palette, 4);
    png_write_info(png, info);
    png_byte row[1] = {0b00'01'10'11};
    png_write_row(png, row);
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);

    EXPECT_THAT(read("a.png", value(2), 4), ElementsAre(0, 0, 255, 0));
    EXPECT_THAT(read("a.png", channel("R"), 4),
                ElementsAre(0, 128, 0, 255));  // colours without a value
}

TEST_F(MatteFile, FloatFilesHaveNoIds) {
    put<float>("a.exr", 1, {1, 2}, OIIO::TypeFloat, {"Y"});
    EXPECT_EQ(read_matte(in("a.exr"), value(1), {2, 1}).error().code, ErrorCode::kUsage);
}

TEST_F(MatteFile, ASequenceHasOneChannel) {
    put<std::uint8_t>("clear.png", 4, {10, 20, 30, 40, 50, 60, 70, 255}, OIIO::TypeUInt8);
    put<std::uint8_t>("full.png", 4, {10, 20, 30, 255, 50, 60, 70, 255}, OIIO::TypeUInt8);
    put<std::uint8_t>("rgb.png", 3, {10, 20, 30, 50, 60, 70}, OIIO::TypeUInt8);
    EXPECT_EQ(channel_of_mattes({in("full.png"), in("clear.png"), in("full.png")}), "A");
    EXPECT_EQ(channel_of_mattes({in("full.png"), in("full.png")}), "Y");
    EXPECT_EQ(channel_of_mattes({in("rgb.png")}), "");
    EXPECT_EQ(channel_of_mattes({in("none.png")}), "");
    EXPECT_EQ(channel_of_mattes({}), "");
}

TEST_F(MatteFile, AMovieIsNotCalledDamaged) {
    put_bytes(in("m.mkv"), {'x'}, 1);
    const auto movie = read_matte(in("m.mkv"), {}, {});
    ASSERT_FALSE(movie);
    EXPECT_EQ(movie.error().code, ErrorCode::kUsage);
    EXPECT_THAT(movie.error().sentence(), HasSubstr("is a movie"));
}

TEST_F(MatteFile, WrongSizeGivesBothSizes) {
    put<std::uint8_t>("a.png", 1, {0, 1, 128, 255}, OIIO::TypeUInt8);
    const auto matte = read_matte(in("a.png"), {}, {640, 360});
    ASSERT_FALSE(matte);
    EXPECT_EQ(matte.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(matte.error().sentence(), HasSubstr("4x1"));
    EXPECT_THAT(matte.error().sentence(), HasSubstr("640x360"));
}

TEST_F(MatteFile, AbsentFileIsMissing) {
    const auto matte = read_matte(in("none.png"), {}, {4, 1});
    ASSERT_FALSE(matte);
    EXPECT_EQ(matte.error().code, ErrorCode::kMissingFrames);
    EXPECT_THAT(matte.error().sentence(), HasSubstr("none.png"));
}

TEST_F(MatteFile, WrittenMatteComesBack) {
    Matte matte(61, 43);
    for (int i = 0; i < 61 * 43; ++i)
        matte.data()[i] = static_cast<std::uint8_t>(i * 7);
    for (const char* name : {"m.png", "m.tif"}) {
        ASSERT_TRUE(write_matte(in(name), matte));
        EXPECT_EQ(read_matte(in(name), {}, {61, 43}).value(), matte);
    }
    EXPECT_EQ(write_matte(in("m.jpg"), matte).error().code, ErrorCode::kUsage);
}

TEST(MatteData, IdsOfTheRenderedClip) {
    const std::string ids =
        test::shared_data_folder() + "/sequences/blender_fox_gt/masks_ids/00000.png";
    if (!std::filesystem::exists(ids)) GTEST_SKIP() << "no evaluation data";
    std::int64_t covered = 0;
    for (int id = 0; id <= 5; ++id) {
        const Matte matte = read_matte(ids, value(id), {854, 480}).value();
        for (std::size_t i = 0; i < matte.size_bytes(); ++i)
            covered += matte.data()[i] == 255;
    }
    EXPECT_EQ(covered, 854 * 480);  // every pixel is of exactly one object
}

ImageF3 shown(const std::vector<std::array<float, 3>>& pixels) {
    ImageF3 out(static_cast<int>(pixels.size()), 1);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        std::copy(pixels[i].begin(), pixels[i].end(), out.data() + 3 * i);
    return out;
}

TEST(MatteJudge, WhiteOnBlackIsAMatteWhateverItsOtherFilesAre) {
    MatteJudge judge;
    judge.add(look_at_matte(shown({{0, 0, 0}}), {}));
    EXPECT_FALSE(judge.is_satisfied()) << "an empty frame says nothing";
    judge.add(look_at_matte(shown({{0, 0, 0}, {1, 1, 1}, {0.3f, 0.3f, 0.3f}}), {}));
    EXPECT_TRUE(judge.is_satisfied());
    EXPECT_TRUE(judge.check("m.png"));
    EXPECT_EQ(judge.warning("m.png"), "");
}

TEST(MatteJudge, ColoursAreNotCoverage) {
    MatteJudge judge;
    judge.add(look_at_matte(shown({{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}), {}));
    EXPECT_FALSE(judge.is_satisfied());
    const Status status = judge.check("rgb.png");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(status.error().sentence(), HasSubstr("rgb.png has colours"));
    MatteJudge by_alpha;
    by_alpha.add(look_at_matte(shown({{1, 0, 0}, {0, 1, 0}}), ImageF1(2, 1, 1.0f)));
    EXPECT_TRUE(by_alpha.check("rgba.png")) << "its alpha is read";
}

TEST(MatteJudge, IdsAreNotCoverage) {
    MatteJudge ids;
    ids.add(look_at_matte(shown({{0, 0, 0}, {1 / 255.f, 1 / 255.f, 1 / 255.f}}), {}));
    EXPECT_THAT(ids.check("ids.png").error().sentence(), HasSubstr("up to 1 of 255"));
    MatteJudge empty;
    empty.add(look_at_matte(shown({{0, 0, 0}, {0, 0, 0}}), {}));
    EXPECT_TRUE(empty.check("none.png")) << "said by frame, elsewhere";
}

TEST(MatteJudge, SaysWhatIsNowhereEmptyOrNowhereFull) {
    MatteJudge levels;
    levels.add(look_at_matte(shown({{0.063f, 0.063f, 0.063f}, {0.92f, 0.92f, 0.92f}}), {}));
    EXPECT_TRUE(levels.check("m.png"));
    EXPECT_THAT(levels.warning("m.png"), HasSubstr("nowhere below 6 %"));
    MatteJudge glass;
    glass.add(look_at_matte(shown({{0, 0, 0}, {0.4f, 0.4f, 0.4f}}), {}));
    EXPECT_THAT(glass.warning("m.png"), HasSubstr("by more than 40 %"));
    MatteJudge all;
    all.add(look_at_matte(shown({{1, 1, 1}, {1, 1, 1}}), {}));
    EXPECT_EQ(all.warning("m.png"), "") << "all of the picture";
}

TEST_F(MatteFile, AlphaIsJudgedWhereItIsRead) {
    put<std::uint8_t>("red.png", 4, {200, 0, 0, 0, 200, 0, 0, 255}, OIIO::TypeUInt8);
    EXPECT_EQ(judge_mattes("red", {in("red.png")}, {}).value(), "");
    put<std::uint8_t>("opaque.png", 4, {200, 0, 0, 255, 0, 0, 200, 255}, OIIO::TypeUInt8);
    EXPECT_FALSE(judge_mattes("opaque", {in("opaque.png")}, {}));
    EXPECT_EQ(judge_mattes("none", {in("none.png")}, {}).value(), "");
}

}  // namespace
}  // namespace weft
