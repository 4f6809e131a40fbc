// What is written is what is read, in every format and at every depth.

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "engine/media/frame_reader.h"
#include "engine/media/image_files.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::HasSubstr;

using RoundTrip = MediaTest;

struct Case {
    const char* name;
    PixelDepth depth;
    int max_code;
};

WriteOptions at(PixelDepth depth) {
    WriteOptions options;
    options.depth = depth;
    options.dpx_bits = 16;
    return options;
}

TEST_F(RoundTrip, IntegerCodesSurvive) {
    for (const Case& c :
         {Case{"a.png", PixelDepth::kU8, 255}, Case{"b.png", PixelDepth::kU16, 65535},
          Case{"a.tif", PixelDepth::kU8, 255}, Case{"b.tif", PixelDepth::kU16, 65535},
          Case{"a.dpx", PixelDepth::kU8, 255}, Case{"b.dpx", PixelDepth::kU16, 65535}}) {
        // 300 × 219 values in three channels: every 16-bit code occurs several times on average.
        const ImageF3 image = random_codes({301, 219}, c.max_code, 1);
        const Status status = write_image(in(c.name), image, {}, at(c.depth));
        ASSERT_TRUE(status) << status.error().text();
        const auto back = read_image(in(c.name));
        ASSERT_TRUE(back) << back.error().text();
        EXPECT_EQ(back->depth, c.depth) << c.name;
        EXPECT_TRUE(back->rgb == image) << c.name;
        EXPECT_EQ(back->nonfinite, 0);
    }
}

TEST_F(RoundTrip, EverySixteenBitCodeSurvives) {
    ImageF3 image(256, 256);
    for (int i = 0; i < 65536; ++i) {
        for (int c = 0; c < 3; ++c)
            image.at(i % 256, i / 256, c) = static_cast<float>(i) / 65535.0f;
    }
    put_frame(in("a.png"), image, PixelDepth::kU16);
    auto input = OIIO::ImageInput::open(in("a.png"));
    std::vector<std::uint16_t> codes(65536 * 3);
    ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeUInt16, codes.data()));
    for (std::size_t i = 0; i < 65536; ++i)
        ASSERT_EQ(codes[3 * i + 1], i);
}

TEST_F(RoundTrip, FloatSurvivesWithNanAndInfinity) {
    ImageF3 image(33, 7);
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 33; ++x) {
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = std::ldexp(1.1f + 0.01f * x, 3 * y - 9);
        }
    }
    image.at(4, 2, 1) = std::numeric_limits<float>::quiet_NaN();
    image.at(5, 2, 0) = std::numeric_limits<float>::infinity();
    image.at(5, 2, 2) = -std::numeric_limits<float>::infinity();
    image.at(6, 2, 2) = -3.5f;
    for (const char* name : {"a.exr", "a.tif"}) {
        ASSERT_TRUE(write_image(in(name), image, {}, at(PixelDepth::kFloat)));
        const PlateFrame back = read_image(in(name)).value();
        EXPECT_EQ(back.depth, PixelDepth::kFloat);
        EXPECT_EQ(back.nonfinite, 2) << name;
        for (std::size_t i = 0; i < 33 * 7 * 3; ++i) {
            ASSERT_EQ(std::bit_cast<std::uint32_t>(back.rgb.data()[i]),
                      std::bit_cast<std::uint32_t>(image.data()[i]))
                << name << " " << i;
        }
    }
}

TEST_F(RoundTrip, HalfSurvives) {
    ImageF3 image(64, 31);
    for (std::size_t i = 0; i < 64 * 31 * 3; ++i) {
        // Values that half holds: 11 bits of mantissa.
        image.data()[i] =
            std::ldexp(static_cast<float>(1024 + i % 1024), static_cast<int>(i % 20) - 20);
    }
    image.at(3, 3, 0) = std::numeric_limits<float>::infinity();
    ASSERT_TRUE(write_image(in("a.exr"), image, {}, at(PixelDepth::kHalf)));
    const PlateFrame back = read_image(in("a.exr")).value();
    EXPECT_EQ(back.depth, PixelDepth::kHalf);
    EXPECT_TRUE(back.rgb == image);
}

TEST_F(RoundTrip, TooLargeForHalfBecomesTheLargestHalf) {
    ASSERT_TRUE(write_image(in("a.exr"), ImageF3(4, 4, 1e6f), {}, at(PixelDepth::kHalf)));
    EXPECT_EQ(read_image(in("a.exr")).value().rgb, ImageF3(4, 4, 65504.0f));
}

TEST_F(RoundTrip, EightBitCodesSurviveInHalf) {
    ImageF3 image(256, 1);
    for (int i = 0; i < 256; ++i)
        image.at(i, 0, 1) = static_cast<float>(i) / 255.0f;
    const WriteOptions options = at(default_depth("a.exr", PixelDepth::kU8));
    ASSERT_TRUE(write_image(in("a.exr"), image, {}, options));
    ASSERT_TRUE(
        write_image(in("b.png"), read_image(in("a.exr")).value().rgb, {}, at(PixelDepth::kU8)));
    EXPECT_EQ(read_image(in("b.png")).value().rgb, image);
}

TEST_F(RoundTrip, AlphaSurvivesUnmultiplied) {
    for (const Case& c :
         {Case{"a.png", PixelDepth::kU8, 255}, Case{"b.png", PixelDepth::kU16, 65535},
          Case{"a.tif", PixelDepth::kU8, 255}, Case{"b.tif", PixelDepth::kU16, 65535}}) {
        const ImageF3 image = random_codes({31, 22}, c.max_code, 2);
        const ImageF3 other = random_codes({31, 22}, c.max_code, 3);
        ImageF1 alpha(31, 22);
        for (int i = 0; i < 31 * 22; ++i)
            alpha.data()[i] = other.data()[3 * i];
        ASSERT_TRUE(write_image(in(c.name), image, alpha, at(c.depth)));
        const PlateFrame back = read_image(in(c.name)).value();
        EXPECT_TRUE(back.rgb == image) << c.name;
        EXPECT_TRUE(back.alpha == alpha) << c.name;
    }
    // Colour above alpha, and under alpha 0, stays in an EXR as well.
    const ImageF1 alpha(9, 9, 0.0f);
    ASSERT_TRUE(write_image(in("a.exr"), ImageF3(9, 9, 2.5f), alpha, at(PixelDepth::kHalf)));
    EXPECT_EQ(read_image(in("a.exr")).value().rgb, ImageF3(9, 9, 2.5f));
    EXPECT_EQ(read_image(in("a.exr")).value().alpha, alpha);
}

// A grey of 0.5 under alpha 0.4, as each format holds it.
TEST_F(RoundTrip, EachFormatHoldsColoursInItsOwnConvention) {
    const ImageF1 alpha(4, 4, 0.4f);
    const auto held = [&](const std::string& name, PixelDepth depth, AlphaKind given,
                          const std::string& source = {}) {
        WriteOptions options = at(depth);
        options.alpha = given;
        options.source = source;
        options.rule.existing = Existing::kReplace;
        const ImageF3 image(4, 4, given == AlphaKind::kStraight ? 0.5f : 0.2f);
        EXPECT_TRUE(write_image(in(name), image, alpha, options));
        return read_image(in(name)).value();
    };
    for (const AlphaKind given : {AlphaKind::kStraight, AlphaKind::kAssociated}) {
        const PlateFrame png = held("a.png", PixelDepth::kU16, given);
        EXPECT_EQ(png.alpha_kind, AlphaKind::kStraight);
        EXPECT_NEAR(png.rgb.at(1, 1), 0.5f, 1e-4f);
        const PlateFrame exr = held("a.exr", PixelDepth::kFloat, given);
        EXPECT_EQ(exr.alpha_kind, AlphaKind::kAssociated);
        EXPECT_NEAR(exr.rgb.at(1, 1), 0.2f, 1e-6f);
        const PlateFrame tiff = held("a.tif", PixelDepth::kU16, given);
        EXPECT_EQ(tiff.alpha_kind, AlphaKind::kStraight);
        EXPECT_NEAR(tiff.rgb.at(1, 1), 0.5f, 1e-4f);
        EXPECT_NEAR(held("a.jpg", PixelDepth::kU8, given).rgb.at(1, 1), 0.2f, 0.02f);
        // A TIFF made from a TIFF keeps its tag and its samples.
        const PlateFrame kept = held("b.tif", PixelDepth::kU16, given, in("a.tif"));
        EXPECT_EQ(kept.alpha_kind, given);
        EXPECT_NEAR(kept.rgb.at(1, 1), given == AlphaKind::kStraight ? 0.5f : 0.2f, 1e-4f);
    }
    // Only a file that can hold light without a body keeps colour under alpha 0 apart from it.
    WriteOptions options = at(PixelDepth::kFloat);
    options.rule.existing = Existing::kReplace;
    ImageF1 some = alpha;
    some.at(2, 2) = 0;
    ASSERT_TRUE(write_image(in("c.exr"), ImageF3(4, 4, 0.5f), some, options));
    EXPECT_EQ(read_image(in("c.exr")).value().rgb.at(2, 2), 0.0f);
    options.alpha = AlphaKind::kAssociated;
    ASSERT_TRUE(write_image(in("c.exr"), ImageF3(4, 4, 0.5f), some, options));
    EXPECT_EQ(read_image(in("c.exr")).value().rgb.at(2, 2), 0.5f);
}

TEST_F(RoundTrip, TenBitDpxKeepsItsCodes) {
    ImageF3 image(1024, 2);
    for (int i = 0; i < 1024; ++i)
        image.at(i, 1, 2) = static_cast<float>(i) / 1023.0f;
    WriteOptions options = at(PixelDepth::kU16);
    options.dpx_bits = 10;
    ASSERT_TRUE(write_image(in("a.dpx"), image, {}, options));
    const PlateFrame once = read_image(in("a.dpx")).value();
    for (int i = 0; i < 1024; ++i)
        EXPECT_NEAR(once.rgb.at(i, 1, 2), image.at(i, 1, 2), 0.5 / 1023);
    ASSERT_TRUE(write_image(in("b.dpx"), once.rgb, {}, options));
    EXPECT_EQ(read_image(in("b.dpx")).value().rgb, once.rgb);
}

TEST_F(RoundTrip, JpegIsCloseAndNotSubsampled) {
    // One red column on blue: 4:2:0 would smear its colour over both neighbours.
    ImageF3 image(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            image.at(x, y, 0) = x == 30 ? 1.0f : 0.0f;
            image.at(x, y, 2) = x == 30 ? 0.0f : 0.6f;
        }
    }
    ASSERT_TRUE(write_image(in("a.jpg"), image, ImageF1(64, 64, 1.0f), at(PixelDepth::kU8)));
    const PlateFrame back = read_image(in("a.jpg")).value();
    EXPECT_TRUE(back.alpha.empty());
    double worst = 0;
    for (std::size_t i = 0; i < 64 * 64 * 3; ++i) {
        worst = std::max<double>(worst, std::abs(back.rgb.data()[i] - image.data()[i]));
    }
    EXPECT_LT(worst, 0.08);
}

TEST_F(RoundTrip, IntegersAreRoundedOnceAndClamped) {
    ImageF3 image(4, 1);
    image.at(0, 0, 0) = 10.5f / 255.0f;  // half up
    image.at(0, 0, 1) = 10.49f / 255.0f;
    image.at(0, 0, 2) = -0.5f;
    image.at(1, 0, 0) = 7.0f;
    image.at(1, 0, 1) = std::numeric_limits<float>::infinity();
    image.at(1, 0, 2) = std::numeric_limits<float>::quiet_NaN();
    image.at(2, 0, 0) = -std::numeric_limits<float>::infinity();
    put_frame(in("a.png"), image);
    const ImageF3 back = read_image(in("a.png")).value().rgb;
    EXPECT_EQ(back.at(0, 0, 0), 11.0f / 255.0f);
    EXPECT_EQ(back.at(0, 0, 1), 10.0f / 255.0f);
    EXPECT_EQ(back.at(0, 0, 2), 0.0f);
    EXPECT_EQ(back.at(1, 0, 0), 1.0f);
    EXPECT_EQ(back.at(1, 0, 1), 1.0f);
    EXPECT_EQ(back.at(1, 0, 2), 0.0f);
    EXPECT_EQ(back.at(2, 0, 0), 0.0f);
}

TEST_F(RoundTrip, SamePixelsGiveTheSameBytesLater) {
    const std::vector<Case> cases{{"a.png", PixelDepth::kU8, 0},
                                  {"a.jpg", PixelDepth::kU8, 0},
                                  {"a.tif", PixelDepth::kU8, 0},
                                  {"a.exr", PixelDepth::kHalf, 0},
                                  {"a.dpx", PixelDepth::kU8, 0}};
    std::vector<std::vector<char>> first;
    for (const Case& c : cases) {
        put_frame(in(c.name), picture({32, 32}, 0), c.depth);
        first.push_back(bytes_of(in(c.name)));
    }
    std::this_thread::sleep_for(
        std::chrono::milliseconds(1100));  // the clock of a date has moved on
    for (std::size_t i = 0; i < cases.size(); ++i) {
        put_frame(in(cases[i].name), picture({32, 32}, 0), cases[i].depth);
        EXPECT_TRUE(bytes_of(in(cases[i].name)) == first[i]) << cases[i].name;
    }
}

TEST(WriteFormat, DefaultDepthKeepsWhatTheFormatHolds) {
    EXPECT_EQ(default_depth("a.png", PixelDepth::kU16), PixelDepth::kU16);
    EXPECT_EQ(default_depth("a.PNG", PixelDepth::kHalf), PixelDepth::kU16);
    EXPECT_EQ(default_depth("a.jpg", PixelDepth::kFloat), PixelDepth::kU8);
    EXPECT_EQ(default_depth("a.tif", PixelDepth::kFloat), PixelDepth::kFloat);
    EXPECT_EQ(default_depth("a.tif", PixelDepth::kHalf), PixelDepth::kFloat);
    EXPECT_EQ(default_depth("a.exr", PixelDepth::kU8), PixelDepth::kHalf);
    EXPECT_EQ(default_depth("a.exr", PixelDepth::kU16), PixelDepth::kFloat);
    EXPECT_EQ(default_depth("a.exr", PixelDepth::kFloat), PixelDepth::kFloat);
}

TEST(WriteFormat, ImpossibleRequestsAreUsage) {
    EXPECT_TRUE(check_format("a.png", at(PixelDepth::kU16)));
    for (const auto& [name, depth] : {std::pair{"a.png", PixelDepth::kFloat},
                                      {"a.jpg", PixelDepth::kU16},
                                      {"a.exr", PixelDepth::kU8},
                                      {"a.tif", PixelDepth::kHalf},
                                      {"a.gif", PixelDepth::kU8},
                                      {"a", PixelDepth::kU8}}) {
        const Status status = check_format(name, at(depth));
        ASSERT_FALSE(status) << name;
        EXPECT_EQ(status.error().code, ErrorCode::kUsage);
        EXPECT_THAT(status.error().sentence(), HasSubstr(name));
    }
    WriteOptions options = at(PixelDepth::kHalf);
    options.exr_compression = "best";
    EXPECT_EQ(check_format("a.exr", options).error().code, ErrorCode::kUsage);
}

TEST_F(RoundTrip, ADpxKeepsTimeCodeAndFrameRateOfItsPlate) {
    OIIO::ImageSpec spec(16, 12, 3, OIIO::TypeUInt16);
    const unsigned int code[2] = {0x01020304, 0};
    spec.attribute("smpte:TimeCode", OIIO::TypeTimeCode, code);
    spec.attribute("dpx:FrameRate", 23.976f);
    spec.attribute("dpx:TemporalFrameRate", 23.976f);
    spec.attribute("dpx:InputDevice", "camera A");
    spec.attribute("oiio:BitsPerSample", 10);
    const std::vector<std::uint16_t> grey(16u * 12 * 3, 0x8000);
    const auto output = OIIO::ImageOutput::create(in("plate.dpx"));
    ASSERT_TRUE(output->open(in("plate.dpx"), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeUInt16, grey.data()));
    ASSERT_TRUE(output->close());
    WriteOptions options;
    options.depth = PixelDepth::kU16;
    options.source = in("plate.dpx");
    ASSERT_TRUE(write_image(in("out.dpx"), ImageF3(16, 12, 0.25f), {}, options));
    const auto input = OIIO::ImageInput::open(in("out.dpx"));
    ASSERT_TRUE(input);
    for (const char* name : {"smpte:TimeCode", "dpx:TimeCode"}) {
        const auto* kept = input->spec().find_attribute(name);
        ASSERT_NE(kept, nullptr) << name;
        EXPECT_EQ(kept->get_string(), "01:02:03:04") << name;
    }
    EXPECT_EQ(input->spec().get_float_attribute("dpx:FrameRate"), 23.976f);
    EXPECT_EQ(input->spec().get_float_attribute("dpx:TemporalFrameRate"), 23.976f);
    EXPECT_EQ(input->spec().get_string_attribute("dpx:InputDevice"), "camera A");
}

}  // namespace
}  // namespace weft
