// Colours through movies: our own writer's, and files tagged in all the ways that others use.
#include <gmock/gmock.h>

#include <cmath>

#include "engine/media/frame_reader.h"
#include "engine/media/frame_writer.h"
#include "tests/media/coded_movie.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class MovieColor : public MediaTest {
  protected:
    PlateFrame read_first(const std::string& name) {
        return open_plate(in(name), {}).value()->read(1001).value();
    }
};

// ---- our writer ------------------------------------------------------------------------------

constexpr int kPatch_px = 32;

// A chart of 8×8 patches: 4 levels of each of R, G, B, black, white and the primaries among them.
std::array<float, 3> patch_color(int i) {
    return {static_cast<float>(i / 16) / 3.0f, static_cast<float>(i / 4 % 4) / 3.0f,
            static_cast<float>(i % 4) / 3.0f};
}
ImageF3 chart() {
    ImageF3 image(8 * kPatch_px, 8 * kPatch_px);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const auto color = patch_color(y / kPatch_px * 8 + x / kPatch_px);
            std::copy(color.begin(), color.end(), image.pixel(x, y));
        }
    }
    return image;
}

TEST_F(MovieColor, FlatPatchesComeBackWithinTwoLevels) {
    auto movie = open_movie(in("a.mp4"), chart().size(), 24).value();
    for (int f = 0; f < 6; ++f)
        ASSERT_TRUE(movie->add(chart()));
    ASSERT_TRUE(movie->close());
    const auto plate = open_plate(in("a.mp4"), {}).value();
    for (const int frame : {1001, 1003, 1006}) {
        const ImageF3 have = plate->read(frame).value().rgb;
        for (int i = 0; i < 64; ++i) {
            const auto want = patch_color(i);
            // Outside the macroblock whose first column mixes with the patch on the left.
            for (const auto& [dx, dy] : {std::pair{16, 16}, {24, 9}, {26, 20}, {18, 28}}) {
                const float* rgb = have.pixel(i % 8 * kPatch_px + dx, i / 8 * kPatch_px + dy);
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_LE(std::abs(rgb[c] - want[c]) * 255, 2.01)
                        << "patch " << i << " channel " << c << " frame " << frame;
                }
            }
        }
    }
}

TEST_F(MovieColor, GreysStayGrey) {
    // A ramp of columns, each level four columns wide.
    ImageF3 ramp(1024, 32);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 1024; ++x)
            std::fill_n(ramp.pixel(x, y), 3, static_cast<float>(x / 4) / 255.0f);
    }
    auto movie = open_movie(in("a.mp4"), ramp.size(), 24).value();
    ASSERT_TRUE(movie->add(ramp));
    ASSERT_TRUE(movie->close());
    const ImageF3 have = read_first("a.mp4").rgb;
    double bias = 0;
    for (int x = 0; x < 1024; ++x) {
        const float* rgb = have.pixel(x, 16);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(rgb[c] * 255, static_cast<float>(x / 4), 2.01) << x;
            EXPECT_NEAR(rgb[c], rgb[0], 1e-6) << x;
        }
        bias += rgb[0] * 255.0 - x / 4;
    }
    EXPECT_NEAR(bias / 1024, 0, 0.15);  // neither darker nor brighter on the whole
}

TEST_F(MovieColor, ChromaIsNotShifted) {
    // A red field that begins at an even column: seen from its middle, the edge's blur is even.
    ImageF3 image({64, 64}, 0.5f);
    for (int y = 0; y < 64; ++y) {
        for (int x = 20; x < 41; ++x) {
            image.at(x, y, 0) = 0.8f;
            image.at(x, y, 1) = image.at(x, y, 2) = 0.4f;
        }
    }
    auto movie = open_movie(in("a.mp4"), image.size(), 24).value();
    ASSERT_TRUE(movie->add(image));
    ASSERT_TRUE(movie->close());
    const ImageF3 have = read_first("a.mp4").rgb;
    double mass = 0, moment = 0;
    for (int x = 8; x < 54; ++x) {
        const double redness = have.at(x, 32, 0) - have.at(x, 32, 2);
        mass += redness;
        moment += redness * x;
    }
    EXPECT_NEAR(moment / mass, 30.0, 0.1);
}

TEST_F(MovieColor, BeyondTheRangeIsClamped) {
    ImageF3 image({32, 32}, 7.0f);
    image.at(0, 0, 0) = std::nanf("");
    for (const char* name : {"a.mkv", "a.mp4"}) {
        auto movie = open_movie(in(name), image.size(), 24).value();
        ASSERT_TRUE(movie->add(image));
        ASSERT_TRUE(movie->add(ImageF3({32, 32}, -3.0f)));
        ASSERT_TRUE(movie->close());
        const auto plate = open_plate(in(name), {}).value();
        EXPECT_NEAR(plate->read(1001).value().rgb.at(20, 20, 1), 1.0f, 1.01 / 255) << name;
        EXPECT_NEAR(plate->read(1002).value().rgb.at(20, 20, 1), 0.0f, 1.01 / 255) << name;
    }
}

// ---- files of others -------------------------------------------------------------------------

struct Standard {
    const char* name;
    AVColorSpace tag;
    Size size;
    double kr, kb;
    AVColorRange range = AVCOL_RANGE_MPEG;
};
class MovieStandard : public MovieColor, public ::testing::WithParamInterface<Standard> {};

// Codes of a colour by the standard's own equations (BT.601-7 2.5, BT.709-6 3, BT.2020-2 4).
Codes encode(const Standard& s, std::array<float, 3> rgb, int bits) {
    const double y = s.kr * rgb[0] + (1 - s.kr - s.kb) * rgb[1] + s.kb * rgb[2];
    const double cb = (rgb[2] - y) / (2 - 2 * s.kb), cr = (rgb[0] - y) / (2 - 2 * s.kr);
    const double unit = std::pow(2.0, bits - 8), full = std::pow(2.0, bits) - 1;
    const bool is_full = s.range == AVCOL_RANGE_JPEG;
    const double luma = is_full ? full * y : unit * (16 + 219 * y);
    const double scale = is_full ? full : unit * 224;
    const auto code = [&](double v) { return static_cast<int>(std::lround(std::min(v, full))); };
    return {code(luma), code(unit * 128 + scale * cb), code(unit * 128 + scale * cr), 0};
}

void expect_bars(const ImageF3& image, double tolerance) {
    for (int i = 0; i < 64; ++i) {
        const auto want = patch_color(i);
        const int x = (2 * i + 1) * image.width() / 128;
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(image.pixel(x, image.height() / 2)[c], want[c], tolerance)
                << "bar " << i << " channel " << c;
        }
    }
}

TEST_P(MovieStandard, EightAndTenBits) {
    const Standard& s = GetParam();
    for (const int bits : {8, 10}) {
        std::vector<Codes> bars;
        for (int i = 0; i < 64; ++i)
            bars.push_back(encode(s, patch_color(i), bits));
        for (const bool subsampled : {true, false}) {
            CodedMovie movie;
            movie.format = bits == 8 ? (subsampled ? AV_PIX_FMT_YUV420P : AV_PIX_FMT_YUV444P)
                                     : (subsampled ? AV_PIX_FMT_YUV422P10 : AV_PIX_FMT_YUV444P10);
            movie.size = s.size;
            movie.matrix = s.tag;
            movie.range = s.range;
            write_bars(in("a.mkv"), movie, bars);
            const auto plate = open_plate(in("a.mkv"), {}).value();
            EXPECT_THAT(plate->warnings(), IsEmpty());
            EXPECT_EQ(plate->depth(), bits == 8 ? PixelDepth::kU8 : PixelDepth::kU16);
            const PlateFrame frame = plate->read(1001).value();
            EXPECT_EQ(frame.depth, plate->depth());
            expect_bars(frame.rgb, bits == 8 ? 2.01 / 255 : 2.01 / 1023);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, MovieStandard,
    ::testing::Values(
        Standard{"Tagged709Small", AVCOL_SPC_BT709, {512, 32}, 0.2126, 0.0722},
        Standard{"Tagged601Large", AVCOL_SPC_SMPTE170M, {1280, 32}, 0.299, 0.114},
        Standard{"Tagged470Bg", AVCOL_SPC_BT470BG, {1280, 32}, 0.299, 0.114},
        Standard{"Tagged2020", AVCOL_SPC_BT2020_NCL, {512, 32}, 0.2627, 0.0593},
        Standard{"UntaggedSd", AVCOL_SPC_UNSPECIFIED, {512, 32}, 0.299, 0.114},
        Standard{"UntaggedHd", AVCOL_SPC_UNSPECIFIED, {1280, 32}, 0.2126, 0.0722},
        Standard{"FullRange", AVCOL_SPC_BT709, {512, 32}, 0.2126, 0.0722, AVCOL_RANGE_JPEG}),
    [](const auto& p) { return std::string(p.param.name); });

TEST_F(MovieColor, RgbOfTenBitsKeepsItsCodes) {
    std::vector<Codes> bars;
    for (const int code : {0, 1, 2, 511, 512, 1000, 1022, 1023})
        bars.push_back({code, 1023 - code, code / 2, 0});
    CodedMovie movie;
    movie.format = AV_PIX_FMT_GBRP10;
    movie.matrix = AVCOL_SPC_RGB;
    movie.range = AVCOL_RANGE_JPEG;
    write_bars(in("a.mkv"), movie, bars);
    const PlateFrame frame = read_first("a.mkv");
    EXPECT_EQ(frame.depth, PixelDepth::kU16);
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const float* rgb = frame.rgb.pixel(static_cast<int>(i) * 8 + 4, 10);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_EQ(std::lround(rgb[c] * 1023), bars[i][c]) << i << " channel " << c;
    }
}

TEST_F(MovieColor, AlphaIsRead) {
    CodedMovie movie;
    movie.format = AV_PIX_FMT_BGRA;
    movie.matrix = AVCOL_SPC_RGB;
    write_bars(in("a.mkv"), movie, {{10, 20, 30, 0}, {40, 50, 60, 128}});
    const PlateFrame frame = read_first("a.mkv");
    ASSERT_EQ(frame.alpha.size(), frame.rgb.size());
    EXPECT_EQ(frame.alpha.at(5, 5) * 255, 0);
    EXPECT_EQ(frame.alpha.at(60, 5) * 255, 128);
    EXPECT_THAT(std::vector<float>(frame.rgb.pixel(60, 5), frame.rgb.pixel(60, 5) + 3),
                ElementsAre(40 / 255.0f, 50 / 255.0f, 60 / 255.0f));
}

TEST_F(MovieColor, AlphaBesideLumaKeepsItsCodes) {
    for (const AVPixelFormat format : {AV_PIX_FMT_YUVA420P, AV_PIX_FMT_YUVA444P}) {
        CodedMovie movie;
        movie.format = format;
        write_bars(in("a.mkv"), movie, {{126, 128, 128, 1}, {126, 128, 128, 128}});
        const PlateFrame frame = read_first("a.mkv");
        ASSERT_EQ(frame.alpha.size(), frame.rgb.size());
        EXPECT_EQ(std::lround(frame.alpha.at(5, 5) * 255), 1);
        EXPECT_EQ(std::lround(frame.alpha.at(60, 5) * 255), 128);
    }
}

TEST_F(MovieColor, GreyIsReadInFullRange) {
    const int want[] = {0, 100, 200, 255};
    for (const AVColorRange range : {AVCOL_RANGE_JPEG, AVCOL_RANGE_UNSPECIFIED}) {
        CodedMovie movie;
        movie.format = AV_PIX_FMT_GRAY8;
        movie.range = range;
        write_bars(in("a.mkv"), movie, {{0}, {100}, {200}, {255}});
        const ImageF3 image = read_first("a.mkv").rgb;
        for (int i = 0; i < 4; ++i) {
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(std::lround(image.at(16 * i + 8, 8, c) * 255), want[i]) << i << c;
        }
    }
}

TEST_F(MovieColor, PhonesThatWereTurned) {
    // Red left, blue right; turned clockwise, red is on top.
    CodedMovie movie;
    movie.size = {64, 32};
    movie.format = AV_PIX_FMT_BGR0;
    for (const int turn : {90, 180, 270}) {
        movie.rotation_deg = turn;
        write_bars(in("a.mov"), movie, {{255, 0, 0, 0}, {0, 0, 255, 0}});
        const ImageF3 image = read_first("a.mov").rgb;
        const Size size = turn == 180 ? Size{64, 32} : Size{32, 64};
        ASSERT_EQ(image.size(), size) << turn;
        const int w = size.width, h = size.height;
        const bool first_red = turn == 90;  // at the top or, turned upside down, at the left
        EXPECT_EQ(image.at(0, 0, 0), first_red ? 1 : 0) << turn;
        EXPECT_EQ(image.at(w - 1, h - 1, 0), first_red ? 0 : 1) << turn;
        if (turn == 180) continue;
        EXPECT_EQ(image.at(w - 1, 0, 0), first_red ? 1 : 0) << turn;
        EXPECT_EQ(image.at(0, h - 1, 0), first_red ? 0 : 1) << turn;
    }
}

TEST_F(MovieColor, HdrIsSaidToBeTakenAsItStands) {
    CodedMovie movie;
    movie.format = AV_PIX_FMT_YUV420P10;
    movie.matrix = AVCOL_SPC_BT2020_NCL;
    movie.transfer = AVCOL_TRC_SMPTE2084;
    write_bars(in("a.mkv"), movie, {{512, 512, 512, 0}});
    const auto warnings = open_plate(in("a.mkv"), {}).value()->warnings();
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("HDR")));
}

}  // namespace
}  // namespace weft
