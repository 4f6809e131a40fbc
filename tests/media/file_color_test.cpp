// What files say of their colours and of how the camera was held.

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <png.h>

#include <cstdio>

#include "engine/media/file_color.h"
#include "engine/media/frame_pacing.h"
#include "engine/media/frame_reader.h"
#include "engine/media/icc_profile.h"
#include "engine/media/image_files.h"
#include "engine/media/orientation.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::HasSubstr;

using FileColorTest = MediaTest;
using OrientationTest = MediaTest;

void put_with(const std::string& path, OIIO::ImageSpec spec) {
    auto output = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(output->open(path, spec)) << output->geterror();
    const std::vector<float> data(
        static_cast<std::size_t>(spec.width * spec.height * spec.nchannels), 0.5f);
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
    ASSERT_TRUE(output->close());
}

FileColor color_of(const std::string& path) {
    return open_plate(path, {}).value()->color();
}

OIIO::ImageSpec exr_with(const std::array<float, 8>& xy) {
    OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeHalf);
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), xy.data());
    return spec;
}

TEST_F(FileColorTest, ExrPrimariesOtherThanRec709AreSaid) {
    put_with(in("a.exr"), OIIO::ImageSpec(4, 4, 3, OIIO::TypeHalf));
    EXPECT_EQ(color_of(in("a.exr")).space, "linear");
    EXPECT_EQ(color_of(in("a.exr")).note, "");
    put_with(in("b.exr"), exr_with({0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f}));
    EXPECT_EQ(color_of(in("b.exr")).note, "");
    put_with(in("c.exr"),
             exr_with({0.713f, 0.293f, 0.165f, 0.83f, 0.128f, 0.044f, 0.32168f, 0.33767f}));
    EXPECT_EQ(color_of(in("c.exr")).note, "has the primaries of ACEScg");
    EXPECT_THAT(read_image(in("c.exr")).value().color.note, HasSubstr("ACEScg"));
    put_with(in("d.exr"), exr_with({0.7f, 0.3f, 0.2f, 0.7f, 0.1f, 0.1f, 0.3f, 0.3f}));
    EXPECT_THAT(color_of(in("d.exr")).note, HasSubstr("other primaries"));
}

TEST_F(FileColorTest, DpxWithALogTransferIsCineon) {
    const std::pair<const char*, const char*> cases[]{{"Logarithmic", "cineon"},
                                                      {"Printing density", "cineon"},
                                                      // ffmpeg writes it into all that it makes.
                                                      {"Linear", "srgb"},
                                                      {"ITU-R 709-4", "srgb"}};
    for (const auto& [transfer, space] : cases) {
        OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeUInt16);
        spec.attribute("dpx:Transfer", transfer);
        put_with(in("a.dpx"), spec);
        EXPECT_EQ(color_of(in("a.dpx")).space, space) << transfer;
    }
    WriteOptions options;
    options.depth = PixelDepth::kU16;
    ASSERT_TRUE(write_image(in("plain.dpx"), picture({8, 8}, 1), {}, options));
    EXPECT_EQ(color_of(in("plain.dpx")).space, "srgb");
    options.dpx_log = true;
    ASSERT_TRUE(write_image(in("log.dpx"), picture({8, 8}, 1), {}, options));
    EXPECT_EQ(color_of(in("log.dpx")).space, "cineon");
}

// A profile with nothing but its name, as version 2 ('desc') and version 4 ('mluc') hold it.
std::string profile_named(const std::string& name, bool version4) {
    const auto number = [](std::size_t value) {
        std::string out;
        for (int shift = 24; shift >= 0; shift -= 8)
            out += static_cast<char>(value >> shift & 255);
        return out;
    };
    std::string tag;
    if (version4) {
        tag = "mluc" + number(0) + number(1) + number(12) + "enUS" + number(2 * name.size() + 2) +
              number(28);
        for (const char c : name)
            tag += std::string("\0", 1) + c;
        tag += std::string(2, '\0');
    } else {
        tag = "desc" + number(0) + number(name.size() + 1) + name + std::string("\0", 1);
    }
    return std::string(128, '\0') + number(1) + "desc" + number(144) + number(tag.size()) + tag;
}

TEST_F(FileColorTest, ProfilesAreNamed) {
    for (const bool version4 : {false, true}) {
        const std::string profile = profile_named("Adobe RGB (1998)", version4);
        const auto* bytes = reinterpret_cast<const unsigned char*>(profile.data());
        EXPECT_EQ(icc_profile_name(bytes, profile.size()), "Adobe RGB (1998)");
        for (std::size_t cut = 0; cut < profile.size(); ++cut)
            EXPECT_EQ(icc_profile_name(bytes, cut), "") << cut;
    }
    EXPECT_EQ(note_of_profile("sRGB IEC61966-2.1"), "");
    EXPECT_EQ(note_of_profile("Display P3"), "has the ICC profile 'Display P3'");

    OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeUInt8);
    const std::string profile = profile_named("Adobe RGB (1998)", false);
    spec.attribute("ICCProfile",
                   OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                   profile.data());
    for (const char* name : {"a.tif", "a.jpg"}) {
        put_with(in(name), spec);
        EXPECT_EQ(color_of(in(name)).note, "has the ICC profile 'Adobe RGB (1998)'") << name;
        EXPECT_EQ(color_of(in(name)).space, "srgb");
    }
}

std::string big_endian(std::size_t value, int bytes) {
    std::string out;
    for (int k = bytes - 1; k >= 0; --k)
        out += static_cast<char>(value >> 8 * k & 255);
    return out;
}

std::string gamma_table(std::initializer_list<int> values) {
    std::string tag = "curv" + big_endian(0, 4) + big_endian(values.size(), 4);
    for (const int value : values)
        tag += big_endian(static_cast<std::uint32_t>(value), 2);
    return tag + std::string(tag.size() % 4, '\0');
}

std::string formula(int kind, std::initializer_list<double> parameters) {
    std::string tag = "para" + big_endian(0, 4) + big_endian(static_cast<std::uint32_t>(kind), 2) +
                      big_endian(0, 2);
    for (const double p : parameters)
        tag += big_endian(static_cast<std::uint32_t>(std::lround(p * 65536)), 4);
    return tag;
}

// A profile of grey displays as libpng wants it (ICC.1:2010, 7.2), with a name and a curve.
std::string grey_profile(const std::string& name, const std::string& curve) {
    std::string description = "desc" + big_endian(0, 4) + big_endian(name.size() + 1, 4) + name;
    description += std::string(4 - description.size() % 4, '\0');
    const std::uint32_t first = 128 + 4 + 2 * 12,
                        second = first + static_cast<std::uint32_t>(description.size()),
                        end = second + static_cast<std::uint32_t>(curve.size());
    std::string header = big_endian(end, 4) + std::string(4, '\0') + big_endian(0x02400000, 4) +
                         "mntrGRAYXYZ " + std::string(12, '\0') + "acsp" + std::string(28, '\0') +
                         big_endian(0xF6D6, 4) + big_endian(0x10000, 4) + big_endian(0xD32D, 4);
    header += std::string(128 - header.size(), '\0');
    return header + big_endian(2, 4) + "desc" + big_endian(first, 4) +
           big_endian(second - first, 4) + "kTRC" + big_endian(second, 4) +
           big_endian(end - second, 4) + description + curve;
}

FileColor color_by(const std::string& profile, const std::string& by_type) {
    return color_of_profile(reinterpret_cast<const unsigned char*>(profile.data()), profile.size(),
                            by_type);
}

TEST_F(FileColorTest, TheCurveOfAProfileDecides) {
    const std::string linear[]{gamma_table({}), gamma_table({256}), gamma_table({0, 32768, 65535}),
                               formula(0, {1.0}), formula(3, {1, 1, 0, 1, 0})};
    for (const std::string& curve : linear) {
        const std::string profile = grey_profile("Linear sRGB", curve);
        EXPECT_EQ(color_by(profile, "srgb").space, "linear");
        EXPECT_EQ(color_by(profile, "srgb").note,
                  "has the ICC profile 'Linear sRGB', which is linear");
        EXPECT_EQ(color_by(profile, "linear").space, "linear");
        EXPECT_EQ(color_by(profile, "linear").note, "");
    }
    const std::string display[]{
        gamma_table({563}), gamma_table({0, 14000, 65535}), formula(0, {2.2}),
        formula(3, {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045}),
        formula(4, {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045, 0, 0})};
    for (const std::string& curve : display) {
        const std::string profile = grey_profile("sRGB", curve);
        EXPECT_EQ(color_by(profile, "srgb").space, "srgb");
        EXPECT_EQ(color_by(profile, "srgb").note, "");
        EXPECT_EQ(color_by(profile, "linear").space, "srgb");
        EXPECT_EQ(color_by(profile, "linear").note,
                  "has the ICC profile 'sRGB', which is not linear");
    }
    const std::string whole = grey_profile("Adobe RGB (1998)", gamma_table({563}));
    EXPECT_EQ(color_by(whole, "srgb").note, "has the ICC profile 'Adobe RGB (1998)'");
    for (std::size_t cut = 0; cut < whole.size(); ++cut)
        EXPECT_EQ(color_by(whole.substr(0, cut), "srgb").space, "srgb") << cut;
    for (const std::string& cut :
         {std::string("curv"),
          big_endian(0x63757276, 4) + big_endian(0, 4) + big_endian(0xFFFFFFFF, 4),
          formula(3, {1.0}), formula(9, {1.0})})
        EXPECT_EQ(color_by(grey_profile("sRGB", cut), "linear").space, "linear");
}

// A grey PNG of 3 × 2 pixels with codes 10, 20, … 60 and what `extra` puts into its header.
template <class F>
void put_png(const std::string& path, F&& extra) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    ASSERT_NE(file, nullptr);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, 3, 2, 8, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    extra(png, info);
    png_write_info(png, info);
    const png_byte rows[2][3]{{10, 20, 30}, {40, 50, 60}};
    for (const auto& row : rows)
        png_write_row(png, row);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

// GIMP and Krita save linear pictures as integers, and display-encoded ones as floats.
TEST_F(FileColorTest, FilesWithAProfileOfTheOtherCurveAreReadByIt) {
    const std::string linear = grey_profile("GIMP built-in Linear sRGB", gamma_table({256}));
    const std::string display = grey_profile("GIMP built-in sRGB", gamma_table({563}));
    const auto put = [&](const std::string& path, const std::string& profile,
                         const OIIO::TypeDesc& type) {
        OIIO::ImageSpec spec(4, 4, 1, type);
        spec.attribute("ICCProfile",
                       OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                       profile.data());
        put_with(path, spec);
    };
    put(in("a.tif"), linear, OIIO::TypeUInt16);
    EXPECT_EQ(color_of(in("a.tif")).space, "linear");
    EXPECT_EQ(color_of(in("a.tif")).note,
              "has the ICC profile 'GIMP built-in Linear sRGB', which is linear");
    put(in("b.tif"), display, OIIO::TypeFloat);
    EXPECT_EQ(color_of(in("b.tif")).space, "srgb");
    EXPECT_EQ(read_image(in("b.tif")).value().color.space, "srgb");
    put(in("c.tif"), linear, OIIO::TypeFloat);
    EXPECT_EQ(color_of(in("c.tif")).note, "");
    // OpenImageIO writes no profile into a WebP: VP8X with its flag, then ICCP.
    put_with(in("a.webp"), OIIO::ImageSpec(4, 4, 3, OIIO::TypeUInt8));
    std::vector<char> webp = bytes_of(in("a.webp"));
    const std::string four{'\x03', '\0', '\0'}, size = big_endian(linear.size(), 4);
    const std::string chunks =
        "VP8X" + std::string{'\x0a', '\0', '\0', '\0', '\x20', '\0', '\0', '\0'} + four + four +
        "ICCP" + std::string(size.rbegin(), size.rend()) + linear;
    webp.insert(webp.begin() + 12, chunks.begin(), chunks.end());
    const std::string total = big_endian(webp.size() - 8, 4);
    std::copy(total.rbegin(), total.rend(), webp.begin() + 4);
    put_bytes(in("a.webp"), webp, webp.size());
    EXPECT_EQ(color_of(in("a.webp")).space, "linear");
    EXPECT_THAT(read_image(in("a.webp")).value().color.note, HasSubstr("Linear sRGB"));
    put_bytes(in("cut.webp"), webp, 40);
    EXPECT_TRUE(profile_of_webp(in("cut.webp")).empty());
    put_png(in("a.png"), [&](png_structp p, png_infop i) {
        png_set_iCCP(p, i, "linear", 0, reinterpret_cast<png_const_bytep>(linear.data()),
                     static_cast<png_uint_32>(linear.size()));
    });
    EXPECT_EQ(color_of(in("a.png")).space, "linear");
}

TEST_F(FileColorTest, PngGammaAndPrimariesAreSaidWithoutTheSrgbChunk) {
    const auto note_with = [&](auto&& extra) {
        put_png(in("a.png"), extra);
        return color_of(in("a.png")).note;
    };
    EXPECT_EQ(note_with([](png_structp, png_infop) {}), "");
    EXPECT_EQ(note_with([](png_structp p, png_infop i) { png_set_gAMA(p, i, 0.45455); }), "");
    EXPECT_EQ(note_with([](png_structp p, png_infop i) { png_set_gAMA(p, i, 1.0); }),
              "is encoded with a gamma of 1.00");
    EXPECT_EQ(note_with([](png_structp p, png_infop i) {
                  png_set_sRGB(p, i, PNG_sRGB_INTENT_PERCEPTUAL);
                  png_set_gAMA(p, i, 0.45455);
              }),
              "");
    EXPECT_EQ(note_with([](png_structp p, png_infop i) {
                  png_set_cHRM(p, i, 0.3127, 0.329, 0.68, 0.32, 0.265, 0.69, 0.15, 0.06);
              }),
              "has the primaries of P3-D65");
    const auto coded = [](png_byte transfer) {
        return [transfer](png_structp p, png_infop i) {
            png_unknown_chunk chunk{{'c', 'I', 'C', 'P', 0}, nullptr, 4, PNG_HAVE_IHDR};
            png_byte data[4]{9, transfer, 0, 1};
            chunk.data = data;
            png_set_keep_unknown_chunks(p, PNG_HANDLE_CHUNK_ALWAYS, chunk.name, 1);
            png_set_unknown_chunks(p, i, &chunk, 1);
        };
    };
    EXPECT_EQ(note_with(coded(16)), "is an HDR picture (PQ or HLG)");
    EXPECT_EQ(note_with(coded(13)), "") << "sRGB";
}

// ---- how the camera was held -------------------------------------------------------------------

// What is to be seen of rows {10, 20, 30} and {40, 50, 60}, by the tag's value from 1.
const std::vector<std::vector<int>> kSeen{{10, 20, 30, 40, 50, 60}, {30, 20, 10, 60, 50, 40},
                                          {60, 50, 40, 30, 20, 10}, {40, 50, 60, 10, 20, 30},
                                          {10, 40, 20, 50, 30, 60}, {40, 10, 50, 20, 60, 30},
                                          {60, 30, 50, 20, 40, 10}, {30, 60, 20, 50, 10, 40}};

TEST(Orientation, TurnsAsTheTagSays) {
    const std::vector<int> stored{10, 20, 30, 40, 50, 60};
    for (int tag = 1; tag <= 8; ++tag)
        EXPECT_EQ(upright(stored, {3, 2}, 1, tag), kSeen[static_cast<std::size_t>(tag - 1)]) << tag;
    EXPECT_EQ(upright(stored, {3, 2}, 1, 0), stored);
    EXPECT_EQ(upright(std::vector<int>{1, 2, 3, 4}, {2, 1}, 2, 2), (std::vector<int>{3, 4, 1, 2}));
}

// A grey picture as codes.
std::vector<int> grey_codes(const PlateFrame& frame) {
    std::vector<int> out;
    for (int y = 0; y < frame.rgb.height(); ++y)
        for (int x = 0; x < frame.rgb.width(); ++x)
            out.push_back(static_cast<int>(std::lround(frame.rgb.at(x, y, 0) * 255)));
    return out;
}

TEST_F(OrientationTest, TiffIsShownAsViewersShowIt) {
    for (int tag = 1; tag <= 8; ++tag) {
        OIIO::ImageSpec spec(3, 2, 1, OIIO::TypeUInt8);
        spec.attribute("Orientation", tag);
        auto output = OIIO::ImageOutput::create(in("a.tif"));
        ASSERT_TRUE(output->open(in("a.tif"), spec));
        const std::uint8_t pixels[]{10, 20, 30, 40, 50, 60};
        ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, pixels));
        ASSERT_TRUE(output->close());
        const PlateFrame frame = read_image(in("a.tif")).value();
        EXPECT_EQ(frame.rgb.size(), tag < 5 ? (Size{3, 2}) : (Size{2, 3})) << tag;
        EXPECT_EQ(grey_codes(frame), kSeen[static_cast<std::size_t>(tag - 1)]) << tag;
        EXPECT_EQ(open_plate(in("a.tif"), {}).value()->size(), frame.rgb.size()) << tag;
        EXPECT_EQ(read_matte(in("a.tif"), {}, {}).value().size(), frame.rgb.size()) << tag;
    }
}

TEST_F(OrientationTest, JpegAndPngOfACameraToo) {
    OIIO::ImageSpec spec(64, 32, 3, OIIO::TypeUInt8);
    spec.attribute("Orientation", 6);
    std::vector<std::uint8_t> pixels(64 * 32 * 3, 0);
    std::fill_n(pixels.begin(), 64 * 16 * 3, std::uint8_t{255});  // the upper half is white
    auto output = OIIO::ImageOutput::create(in("a.jpg"));
    ASSERT_TRUE(output->open(in("a.jpg"), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, pixels.data()));
    ASSERT_TRUE(output->close());
    const PlateFrame frame = read_image(in("a.jpg")).value();
    ASSERT_EQ(frame.rgb.size(), (Size{32, 64}));
    EXPECT_LT(frame.rgb.at(2, 32, 0), 0.1f);  // row 0 is the right-hand side
    EXPECT_GT(frame.rgb.at(29, 32, 0), 0.9f);

    put_png(in("a.png"), [](png_structp p, png_infop i) {
        png_byte exif[]{'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1, 1, 18, 0, 3, 0, 0, 0, 1, 0, 6, 0, 0};
        png_set_eXIf_1(p, i, sizeof exif, exif);
    });
    EXPECT_EQ(grey_codes(read_image(in("a.png")).value()), kSeen[5]);
}

TEST(Orientation, ExifIsReadInBothByteOrdersAndNeverBeyondItsEnd) {
    const std::vector<unsigned char> motorola{'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1, 1,
                                              18,  0,   3, 0,  0, 0, 1, 0, 8, 0, 0};
    const std::vector<unsigned char> intel{'I', 'I', 42, 0, 8, 0, 0, 0, 1, 0, 18,
                                           1,   3,   0,  1, 0, 0, 0, 5, 0, 0, 0};
    EXPECT_EQ(orientation_of_exif(motorola.data(), motorola.size()), 8);
    EXPECT_EQ(orientation_of_exif(intel.data(), intel.size()), 5);
    for (std::size_t cut = 0; cut < intel.size(); ++cut)
        EXPECT_EQ(orientation_of_exif(intel.data(), cut), 1) << cut;
    const std::vector<unsigned char> far{'M', 'M', 0, 42, 255, 255, 255, 255, 0, 1};
    EXPECT_EQ(orientation_of_exif(far.data(), far.size()), 1);
}

// ---- movies ------------------------------------------------------------------------------------

TEST(FramePacingTest, ToleratesTheRoundingOfTimeStamps) {
    const auto varies = [](const std::vector<int>& stamps) {
        FramePacing pacing;
        for (const int stamp : stamps)
            pacing.add(stamp);
        return pacing.varies();
    };
    EXPECT_FALSE(varies({}));
    EXPECT_FALSE(varies({0, 33}));
    EXPECT_FALSE(varies({0, 33, 67, 100, 133, 167}));  // 30 fps in milliseconds
    EXPECT_FALSE(varies({0, 3003, 6006, 9009}));
    EXPECT_TRUE(varies({0, 33, 67, 133, 167}));  // one frame is left out
    EXPECT_TRUE(varies({0, 40, 80, 100, 120}));
}

}  // namespace
}  // namespace weft
