// PNG is written by our own encoder, and plain PNG is read without libpng: both must agree with
// libpng about every pixel, and about what is damaged.

#include <OpenImageIO/imageio.h>
#include <png.h>
#include <zlib.h>

#include <array>
#include <cstring>
#include <numeric>

#include "engine/core/parallel.h"
#include "engine/media/image_files.h"
#include "engine/media/png_plain.h"
#include "engine/media/png_writer.h"
#include "engine/media/raster.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Bytes = std::vector<unsigned char>;

struct Chunk {
    std::string name;
    Bytes data;
};

std::vector<Chunk> chunks_in(const std::vector<char>& file) {
    std::vector<Chunk> found;
    const auto* bytes = reinterpret_cast<const unsigned char*>(file.data());
    for (std::size_t at = 8; at + 12 <= file.size();) {
        const std::size_t count = big_endian_u32(bytes + at);
        found.push_back(
            {std::string(file.data() + at + 4, 4), Bytes(bytes + at + 8, bytes + at + 8 + count)});
        EXPECT_EQ(big_endian_u32(bytes + at + 8 + count),
                  crc32(0, bytes + at + 4, static_cast<unsigned>(count + 4)));
        at += 12 + count;
    }
    return found;
}

std::vector<std::string> names_of(const std::vector<Chunk>& chunks) {
    std::vector<std::string> names;
    names.reserve(chunks.size());
    for (const Chunk& chunk : chunks)
        names.push_back(chunk.name);
    return names;
}

std::string text_of(const Chunk& chunk) {
    return {chunk.data.begin(), chunk.data.end()};
}

std::vector<char> file_of(const std::vector<Chunk>& chunks) {
    std::vector<char> file(kPngSignature.begin(), kPngSignature.end());
    const auto number = [&](std::uint32_t value) {
        unsigned char four[4];
        put_big_endian_u32(four, value);
        file.insert(file.end(), std::begin(four), std::end(four));
    };
    for (const Chunk& chunk : chunks) {
        number(static_cast<std::uint32_t>(chunk.data.size()));
        Bytes covered(chunk.name.begin(), chunk.name.end());
        covered.insert(covered.end(), chunk.data.begin(), chunk.data.end());
        file.insert(file.end(), covered.begin(), covered.end());
        number(static_cast<std::uint32_t>(
            crc32(0, covered.data(), static_cast<unsigned>(covered.size()))));
    }
    return file;
}

Bytes deflated(const Bytes& raw) {
    uLongf count = compressBound(raw.size());
    Bytes out(count);
    EXPECT_EQ(compress2(out.data(), &count, raw.data(), raw.size(), 6), Z_OK);
    out.resize(count);
    return out;
}

// Codes with runs, edges and noise.
template <class T>
std::vector<T> codes(Size size, int channels) {
    std::vector<T> out(static_cast<std::size_t>(size.width * size.height * channels));
    Rng rng(5);
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = static_cast<T>(i % 7 == 0 ? rng.below(65536) : (i / 40) * 257 + rng.below(3));
    }
    return out;
}

template <class T>
Samples samples_of(const std::vector<T>& values, Size size, int channels) {
    return {size, channels, sizeof(T) == 2 ? SampleKind::kU16 : SampleKind::kU8, values.data()};
}

class Png : public MediaTest {
  protected:
    void put(const std::string& name, const std::vector<char>& bytes) const {
        put_bytes(in(name), bytes, bytes.size());
    }

    template <class T>
    void put_encoded(const std::vector<T>& values, Size size, int channels,
                     std::size_t largest_chunk = kLargestPngChunk) const {
        const EncodedFile file =
            encode_png(samples_of(values, size, channels), WriteOptions{}, largest_chunk);
        const auto* begin = reinterpret_cast<const char*>(file.data.get());
        put("a.png", {begin, begin + file.size});
    }

    // As OpenImageIO reads it, which means libpng.
    template <class T>
    std::vector<T> by_libpng(int channels) const {
        auto input = OIIO::ImageInput::open(in("a.png"));
        if (!input || input->spec().nchannels != channels) return {};
        std::vector<T> out(input->spec().image_pixels() * static_cast<std::size_t>(channels));
        OIIO::ImageSpec config;
        config.attribute("oiio:UnassociatedAlpha", 1);
        OIIO::ImageSpec spec;
        input->close();
        EXPECT_TRUE(input->open(in("a.png"), spec, config));
        EXPECT_TRUE(
            input->read_image(0, 0, 0, channels, OIIO::TypeDescFromC<T>::value(), out.data()));
        return out;
    }

    template <class T>
    std::vector<T> by_us() const {
        const auto raster = read_raster(in("a.png"), {});
        return raster ? std::get<std::vector<T>>(raster->samples) : std::vector<T>{};
    }

    // Whether the file is read without libpng.
    bool is_plain(const PngShape& shape) const {
        const auto bytes = bytes_of(in("a.png"));
        const std::string_view all(bytes.data(), bytes.size());
        const auto file = InputFile::open(in("a.png"));
        Bytes pixels(shape.filtered_bytes());
        return file && read_plain_png(*file, all.find("IDAT") - 4, shape, pixels);
    }

    void put_by_libpng(const Bytes& rows, const PngShape& shape, int filter, int interlace) const {
        FILE* const file = std::fopen(in("a.png").c_str(), "wb");
        ASSERT_TRUE(file);
        png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
        png_infop info = png_create_info_struct(png);
        png_init_io(png, file);
        constexpr std::array kTypes{PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                    PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
        png_set_IHDR(png, info, static_cast<png_uint_32>(shape.size.width),
                     static_cast<png_uint_32>(shape.size.height), 8 * shape.bytes_per_sample,
                     kTypes[static_cast<std::size_t>(shape.channels - 1)], interlace,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_filter(png, 0, filter);
        png_write_info(png, info);
        std::vector<png_bytep> lines;
        lines.reserve(static_cast<std::size_t>(shape.size.height));
        for (int y = 0; y < shape.size.height; ++y)
            lines.push_back(const_cast<png_bytep>(rows.data()) +
                            static_cast<std::size_t>(y) * shape.row_bytes());
        png_write_image(png, lines.data());
        png_write_end(png, info);
        png_destroy_write_struct(&png, &info);
        std::fclose(file);
    }

    // A sound file of noise whose chunks a test may change.
    std::vector<Chunk> sound() const {
        put_encoded(codes<std::uint8_t>(kSize, 3), kSize, 3);
        return chunks_in(bytes_of(in("a.png")));
    }
    static Bytes& pixels_of(std::vector<Chunk>& chunks) { return chunks[3].data; }

    static constexpr Size kSize{40, 30};
    static constexpr PngShape kShape{kSize, 3, 1};
};

TEST_F(Png, LibpngReadsWhatIsWritten) {
    for (const Size size : {Size{1, 1}, {1, 9}, {2, 1}, {301, 67}}) {
        for (const int channels : {1, 3, 4}) {
            const auto narrow = codes<std::uint8_t>(size, channels);
            put_encoded(narrow, size, channels);
            EXPECT_EQ(by_libpng<std::uint8_t>(channels), narrow);
            EXPECT_EQ(by_us<std::uint8_t>(), narrow);
            EXPECT_TRUE(is_plain({size, channels, 1}));
            const auto wide = codes<std::uint16_t>(size, channels);
            put_encoded(wide, size, channels);
            EXPECT_EQ(by_libpng<std::uint16_t>(channels), wide);
            EXPECT_EQ(by_us<std::uint16_t>(), wide);
            EXPECT_TRUE(is_plain({size, channels, 2}));
        }
    }
}

TEST_F(Png, EveryFilterOfEveryKindIsReadAsLibpngReadsIt) {
    constexpr std::array kFilters{PNG_FILTER_NONE, PNG_FILTER_SUB,   PNG_FILTER_UP,
                                  PNG_FILTER_AVG,  PNG_FILTER_PAETH, PNG_ALL_FILTERS};
    for (const int filter : kFilters) {
        for (const int channels : {1, 2, 3, 4}) {
            const Size size{37, 19};
            const PngShape narrow{size, channels, 1}, wide{size, channels, 2};
            put_by_libpng(codes<std::uint8_t>(size, channels), narrow, filter, PNG_INTERLACE_NONE);
            EXPECT_EQ(by_us<std::uint8_t>(), codes<std::uint8_t>(size, channels));
            EXPECT_TRUE(is_plain(narrow));
            put_by_libpng(codes<std::uint8_t>(size, 2 * channels), wide, filter,
                          PNG_INTERLACE_NONE);
            EXPECT_EQ(by_us<std::uint16_t>(), by_libpng<std::uint16_t>(channels));
            EXPECT_TRUE(is_plain(wide));
        }
    }
}

TEST_F(Png, InterlacedPixelsAreTheSame) {
    const auto values = codes<std::uint8_t>(kSize, 3);
    put_by_libpng(values, kShape, PNG_ALL_FILTERS, PNG_INTERLACE_ADAM7);
    EXPECT_EQ(by_us<std::uint8_t>(), values);
}

TEST_F(Png, BytesDoNotDependOnThreads) {
    const Size size{123, 211};
    const auto values = codes<std::uint16_t>(size, 4);
    std::vector<std::vector<char>> files;
    const int threads = thread_count();
    for (const int count : {1, 2, 5}) {
        set_thread_count(count);
        put_encoded(values, size, 4);
        files.push_back(bytes_of(in("a.png")));
    }
    set_thread_count(threads);
    EXPECT_EQ(files[0], files[1]);
    EXPECT_EQ(files[0], files[2]);
}

TEST_F(Png, ChunksAroundThePixelsAreThose) {
    WriteOptions options;
    options.rule = WriteRule::own();
    ASSERT_TRUE(write_image(in("a.png"), picture({9, 5}, 0), {}, options));
    EXPECT_THAT(names_of(chunks_in(bytes_of(in("a.png")))),
                ElementsAre("IHDR", "oFFs", "tIME", "IDAT", "IEND"));
    options.pixel_aspect = 1.4222;
    options.metadata = {{"weft:version", "1.0"}, {"weft:textures", "t"}, {"weft:licences", "CC0"}};
    ASSERT_TRUE(write_image(in("a.png"), picture({9, 5}, 0), {}, options));
    const auto chunks = chunks_in(bytes_of(in("a.png")));
    ASSERT_THAT(names_of(chunks),
                ElementsAre("IHDR", "oFFs", "pHYs", "tIME", "tEXt", "tEXt", "IDAT", "IEND"));
    EXPECT_EQ(chunks[2].data, (Bytes{0, 0, 0, 100, 0, 0, 0, 142, 0}));
    EXPECT_EQ(chunks[3].data, (Bytes{0x07, 0xb2, 1, 1, 0, 0, 0}));
    EXPECT_EQ(text_of(chunks[4]),
              std::string("Software\0", 9) + "weft 1.0 settings= seed= backend=");
    EXPECT_EQ(text_of(chunks[5]), std::string("Copyright\0", 10) + "textures t; licences CC0");
}

TEST_F(Png, MoreThanOneChunkHoldsLongPixels) {
    const auto values = codes<std::uint8_t>(kSize, 3);
    put_encoded(values, kSize, 3, 100);
    EXPECT_GT(chunks_in(bytes_of(in("a.png"))).size(), 10u);
    EXPECT_EQ(by_libpng<std::uint8_t>(3), values);
    EXPECT_EQ(by_us<std::uint8_t>(), values);
    EXPECT_TRUE(is_plain(kShape));
}

TEST_F(Png, TextBehindThePixelsIsNoReasonForLibpng) {
    auto chunks = sound();
    chunks.insert(chunks.end() - 1, {"tEXt", {'a', 0, 'b'}});
    put("a.png", file_of(chunks));
    EXPECT_TRUE(is_plain(kShape));
    EXPECT_EQ(by_us<std::uint8_t>(), codes<std::uint8_t>(kSize, 3));
}

TEST_F(Png, UnusualFilesAreLeftToLibpngWhichReadsThem) {
    const auto values = codes<std::uint8_t>(kSize, 3);
    auto longer = sound();
    pixels_of(longer).push_back(0);  // behind the end of the stream
    auto private_chunk = sound();
    private_chunk.insert(private_chunk.end() - 1, {"weFt", {1, 2, 3}});
    auto long_text = sound();
    long_text.insert(long_text.end() - 1, {"tEXt", Bytes(9000, 'x')});
    for (const auto& chunks : {longer, private_chunk, long_text}) {
        put("a.png", file_of(chunks));
        EXPECT_FALSE(is_plain(kShape));
        EXPECT_EQ(by_us<std::uint8_t>(), values);
    }
}

// Readers that do not know the chunk give an animation's first picture.
TEST_F(Png, AnAnimationIsRefused) {
    put_frame(in("a.png"), picture({9, 5}, 0));
    const auto put_animation = [&](unsigned char pictures) {
        auto chunks = chunks_in(bytes_of(in("a.png")));
        chunks.insert(chunks.begin() + 1, {"acTL", {0, 0, 0, pictures, 0, 0, 0, 0}});
        const auto bytes = file_of(chunks);
        put_bytes(in("animated.png"), bytes, bytes.size());
    };
    put_animation(2);
    const auto refused = read_image(in("animated.png"));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(refused.error().sentence(), ::testing::HasSubstr("animation"));
    put_animation(1);
    EXPECT_EQ(read_image(in("animated.png")).value().rgb, picture({9, 5}, 0));
}

TEST_F(Png, DamageIsWhatLibpngSaysItIs) {
    auto cut = sound(), bad_filter = sound(), too_few = sound(), no_end = sound(),
         small_window = sound(), wrong_sum = sound();
    pixels_of(cut).resize(pixels_of(cut).size() / 2);
    Bytes rows(kShape.filtered_bytes());
    rows[0] = 9;
    pixels_of(bad_filter) = deflated(rows);
    rows[0] = 0;
    pixels_of(too_few) = deflated(Bytes(rows.begin(), rows.end() - 1));
    no_end.pop_back();
    pixels_of(small_window)[0] = 0x08;
    pixels_of(wrong_sum).back() ^= 1;
    for (const auto& [chunks, reason] : {std::pair{cut, "Not enough"},
                                         {bad_filter, "bad adaptive filter value"},
                                         {too_few, "Not enough"},
                                         {no_end, "Read Error"},
                                         {small_window, "check"},
                                         {wrong_sum, "incorrect data check"}}) {
        put("a.png", file_of(chunks));
        EXPECT_FALSE(is_plain(kShape)) << reason;
        const auto frame = read_image(in("a.png"));
        ASSERT_FALSE(frame) << reason;
        EXPECT_EQ(frame.error().code, ErrorCode::kUnreadable);
        EXPECT_THAT(frame.error().sentence(), HasSubstr(reason));
    }
}

TEST_F(Png, AWrongChecksumOrLengthIsDamage) {
    const auto whole = file_of(sound());
    const std::string_view all(whole.data(), whole.size());
    const std::size_t pixels = all.find("IDAT");
    // The length, a pixel and the checksum of the pixels' chunk; the checksum of the last one.
    for (const std::size_t at : {pixels - 4, pixels + 20, whole.size() - 13, whole.size() - 1}) {
        auto bytes = whole;
        bytes[at] ^= 0x40;
        put("a.png", bytes);
        EXPECT_FALSE(is_plain(kShape)) << at;
        EXPECT_EQ(read_image(in("a.png")).error().code, ErrorCode::kUnreadable) << at;
    }
}

}  // namespace
}  // namespace weft
