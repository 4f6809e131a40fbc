// A file that was cut off is never read as a frame, wherever it was cut.

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>

#include "engine/media/decode_limit.h"
#include "engine/media/image_files.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::HasSubstr;

class Truncation : public MediaTest {
  protected:
    void expect_never_read(const std::string& name, PixelDepth depth, int dpx_bits = 10) {
        WriteOptions options;
        options.depth = depth;
        options.dpx_bits = dpx_bits;
        ASSERT_TRUE(write_image(in("whole_" + name), picture({160, 120}, 3), {}, options));
        const auto bytes = bytes_of(in("whole_" + name));
        ASSERT_TRUE(read_image(in("whole_" + name)));
        for (std::size_t i = 0; i < 40; ++i)
            expect_unreadable(name, bytes, bytes.size() * i / 40);
        for (std::size_t i = 1; i <= 4; ++i)
            expect_unreadable(name, bytes, bytes.size() - i);
    }

    void expect_unreadable(const std::string& name, const std::vector<char>& bytes,
                           std::size_t count) {
        put_bytes(in(name), bytes, count);
        testing::internal::CaptureStderr();
        const auto frame = read_image(in(name));
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << name << " cut to " << count;
        ASSERT_FALSE(frame) << name << " cut to " << count << " of " << bytes.size();
        EXPECT_EQ(frame.error().code, ErrorCode::kUnreadable);
        EXPECT_THAT(frame.error().sentence(), HasSubstr(name));
        EXPECT_EQ(frame.error().sentence().find('\n'), std::string::npos);
    }
};

TEST_F(Truncation, Png) {
    expect_never_read("a.png", PixelDepth::kU8);
}
TEST_F(Truncation, Png16) {
    expect_never_read("a16.png", PixelDepth::kU16);
}
TEST_F(Truncation, Jpeg) {
    expect_never_read("a.jpg", PixelDepth::kU8);
}
TEST_F(Truncation, ExrHalf) {
    expect_never_read("a.exr", PixelDepth::kHalf);
}
// OpenEXR would allocate two gigabytes before it finds that they are not there.
TEST_F(Truncation, ExrAttributeBeyondTheFile) {
    put_frame(in("whole.exr"), picture({160, 120}, 3), PixelDepth::kHalf);
    auto bytes = bytes_of(in("whole.exr"));
    const std::string name("compression\0compression\0", 24);
    const auto at = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
    ASSERT_NE(at, bytes.end());
    at[24 + 3] = 0x7f;
    put_bytes(in("claims.exr"), bytes, bytes.size());
    const auto frame = read_image(in("claims.exr"));
    ASSERT_FALSE(frame);
    EXPECT_THAT(frame.error().sentence(), HasSubstr("bytes for the attribute 'compression'"));
}
// OpenImageIO would try all its readers: that of DICOM reads to the end of an endless file, that of
// FFmpeg follows a list to other files.
TEST_F(Truncation, WhatIsNoPictureIsNotSearchedForOne) {
    put_frame(in("whole.png"), picture({32, 24}, 3), PixelDepth::kU8);
    const std::string list = "ffconcat version 1.0\nfile whole.png\n";
    put_bytes(in("list.png"), {list.begin(), list.end()}, list.size());
    put_bytes(in("zeros.png"), std::vector<char>(64), 64);
    std::filesystem::resize_file(in("zeros.png"), std::uintmax_t{8} << 30);
    for (const char* name : {"list.png", "zeros.png"}) {
        const auto start = std::chrono::steady_clock::now();
        const auto frame = read_image(in(name));
        ASSERT_FALSE(frame) << name;
        EXPECT_THAT(frame.error().sentence(), HasSubstr("its kind is unknown"));
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5)) << name;
    }
}
TEST_F(Truncation, ExtensionsAreNotBelieved) {
    put_frame(in("a.jpg"), picture({32, 24}, 3), PixelDepth::kU8);
    std::filesystem::rename(in("a.jpg"), in("a.tif"));
    EXPECT_TRUE(read_image(in("a.tif")));
}
TEST_F(Truncation, ExrFloat) {
    expect_never_read("b.exr", PixelDepth::kFloat);
}
TEST_F(Truncation, Tiff) {
    expect_never_read("a.tif", PixelDepth::kU8);
}
TEST_F(Truncation, TiffFloat) {
    expect_never_read("b.tif", PixelDepth::kFloat);
}
TEST_F(Truncation, Dpx) {
    expect_never_read("a.dpx", PixelDepth::kU8);
}
TEST_F(Truncation, DpxOfTenTwelveAndSixteenBits) {
    for (const int bits : {10, 12, 16})
        expect_never_read("a" + std::to_string(bits) + ".dpx", PixelDepth::kU16, bits);
}

// As ffmpeg writes lines of 39 bytes; OpenImageIO would read them one byte further on each time.
TEST_F(Truncation, DpxWhoseLinesAreFilledIsRefused) {
    constexpr Size kPicture{13, 9};
    WriteOptions options;
    options.depth = PixelDepth::kU8;
    ASSERT_TRUE(write_image(in("a.dpx"), picture(kPicture, 3), {}, options));
    ASSERT_TRUE(read_image(in("a.dpx")));
    const auto bytes = bytes_of(in("a.dpx"));
    const std::ptrdiff_t line = 3 * kPicture.width, pixels = line * kPicture.height;
    std::vector<char> filled(bytes.begin(), bytes.end() - pixels);
    for (auto at = bytes.end() - pixels; at != bytes.end(); at += line) {
        filled.insert(filled.end(), at, at + line);
        filled.push_back(0);
    }
    put_bytes(in("filled.dpx"), filled, filled.size());
    const auto frame = read_image(in("filled.dpx"));
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(frame.error().sentence(), HasSubstr("filled to four bytes"));
}

TEST_F(Truncation, DamagedPngIsUnreadableInOneLine) {
    put_frame(in("whole.png"), picture({160, 120}, 3));
    auto bytes = bytes_of(in("whole.png"));
    bytes[bytes.size() / 2] ^= 0x20;
    expect_unreadable("flipped.png", bytes, bytes.size());
}

TEST_F(Truncation, StrayBytesInAJpegAreHarmless) {
    put_frame(in("whole.jpg"), picture({160, 120}, 3));
    auto bytes = bytes_of(in("whole.jpg"));
    bytes.insert(bytes.end() - 2, {'\x11', '\x22', '\x33'});  // before the end marker
    put_bytes(in("stray.jpg"), bytes, bytes.size());
    ASSERT_TRUE(read_image(in("stray.jpg")));
    EXPECT_EQ(read_image(in("stray.jpg")).value().rgb, read_image(in("whole.jpg")).value().rgb);
}

TEST_F(Truncation, TextIsNoPicture) {
    const std::string text = "not a picture at all, whatever its name says";
    for (const char* name : {"a.png", "a.jpg", "a.exr", "a.tif", "a.dpx"}) {
        put_bytes(in(name), {text.begin(), text.end()}, text.size());
        EXPECT_EQ(read_image(in(name)).error().code, ErrorCode::kUnreadable) << name;
    }
    EXPECT_EQ(read_image(in("none.png")).error().code, ErrorCode::kUnreadable);
    EXPECT_EQ(read_image(folder_.string()).error().code, ErrorCode::kUnreadable);
}

TEST_F(Truncation, AbsurdSizeIsRefusedBeforeMemoryIsTaken) {
    put_frame(in("a.png"), picture({16, 16}, 3));
    auto bytes = bytes_of(in("a.png"));
    // Width and height 1,000,000 in the header, with the checksum that belongs to them.
    const unsigned char header[] = {0x00, 0x0F, 0x42, 0x40, 0x00, 0x0F, 0x42, 0x40, 8, 2, 0, 0, 0};
    std::uint32_t crc = 0xFFFFFFFFu;
    const auto feed = [&](unsigned char byte) {
        crc ^= byte;
        for (int k = 0; k < 8; ++k)
            crc = (crc >> 1) ^ ((crc & 1) ? 0xEDB88320u : 0u);
    };
    for (const char c : std::string("IHDR"))
        feed(static_cast<unsigned char>(c));
    for (const unsigned char c : header)
        feed(c);
    crc = ~crc;
    std::copy(std::begin(header), std::end(header), bytes.begin() + 16);
    for (int k = 0; k < 4; ++k)
        bytes[static_cast<std::size_t>(29 + k)] = static_cast<char>(crc >> (24 - 8 * k));
    put_bytes(in("huge.png"), bytes, bytes.size());
    const auto frame = read_image(in("huge.png"));
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().code, ErrorCode::kNoSpace) << frame.error().text();
    EXPECT_THAT(frame.error().sentence(), HasSubstr("1000000x1000000"));
}

TEST_F(Truncation, APictureOverTheLimitOfOneIsRefused) {
    constexpr std::int64_t kLimit_bytes = 64 * 64 * 4 * sizeof(float);
    const std::int64_t usual = decode_limit_bytes();
    for (const char* name : {"a.png", "a.tif"}) {
        put_frame(in(name), picture({65, 64}, 3));
        set_decode_limit_bytes(kLimit_bytes);
        const auto refused = read_image(in(name));
        set_decode_limit_bytes(0);
        ASSERT_FALSE(refused) << name;
        EXPECT_EQ(refused.error().code, ErrorCode::kNoSpace) << refused.error().text();
        EXPECT_TRUE(read_image(in(name))) << name;
    }
    EXPECT_EQ(decode_limit_bytes(), usual);
}

}  // namespace
}  // namespace weft
