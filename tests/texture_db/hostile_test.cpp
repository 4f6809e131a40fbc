// Files that lie, climb, burst or are cut short.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/texture_db/scratch.h"
#include "texture_db/packages.h"
#include "texture_db/picture_file.h"
#include "texture_db/sample_codec.h"
#include "texture_db/zip_reader.h"

namespace weft {
namespace {

using testing::HasSubstr;

std::string number(std::uint32_t v, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i)
        out += static_cast<char>(v >> (8 * i) & 255u);
    return out;
}

struct Member {
    std::string path, data;
    std::uint32_t claimed_bytes = 0;  ///< 0: the truth.
    std::uint32_t crc = 0;
};

// A zip of stored (not packed) members.
std::string zip_of(const std::vector<Member>& members) {
    std::string out, directory;
    for (const Member& m : members) {
        const auto size = static_cast<std::uint32_t>(m.data.size());
        const std::uint32_t claimed = m.claimed_bytes ? m.claimed_bytes : size;
        const std::string common = number(20, 2) + number(0, 2) + number(0, 2) + number(0, 4) +
                                   number(m.crc, 4) + number(size, 4) + number(claimed, 4) +
                                   number(static_cast<std::uint32_t>(m.path.size()), 2) +
                                   number(0, 2);
        directory += number(0x02014b50, 4) + number(20, 2) + common + number(0, 2) + number(0, 2) +
                     number(0, 2) + number(0, 4) +
                     number(static_cast<std::uint32_t>(out.size()), 4) + m.path;
        out += number(0x04034b50, 4) + common + m.path + m.data;
    }
    const auto offset = static_cast<std::uint32_t>(out.size()),
               count = static_cast<std::uint32_t>(members.size());
    return out + directory + number(0x06054b50, 4) + number(0, 4) + number(count, 2) +
           number(count, 2) + number(static_cast<std::uint32_t>(directory.size()), 4) +
           number(offset, 4) + number(0, 2);
}

void write(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

TEST(Zip, PathsThatClimbOutAreRefused) {
    const Scratch scratch;
    write(scratch.at("a.zip"), zip_of({{"good/wood.png", "x", 0, 0},
                                       {"../../evil.png", "x", 0, 0},
                                       {"/etc/evil.png", "x", 0, 0},
                                       {"a/../../evil.png", "x", 0, 0},
                                       {"C:\\evil.png", "x", 0, 0},
                                       {"a//b.png", "x", 0, 0}}));
    const auto zip = ZipReader::open(scratch.at("a.zip"));
    ASSERT_TRUE(zip) << zip.error().text();
    ASSERT_EQ(zip->entries().size(), 1u);
    EXPECT_EQ(zip->entries()[0].path, "good/wood.png");
    EXPECT_EQ(zip->refused().size(), 5u);
}

TEST(Zip, BombsAndWrongChecksumsAreRefused) {
    const Scratch scratch;
    write(scratch.at("a.zip"),
          zip_of({{"bomb.png", "x", 4'000'000'000u, 0}, {"wrong.png", "data", 0, 0x12345678}}));
    auto zip = ZipReader::open(scratch.at("a.zip"));
    ASSERT_TRUE(zip);
    EXPECT_THAT(zip->refused(), testing::ElementsAre("bomb.png"));
    ASSERT_EQ(zip->entries().size(), 1u);
    const auto data = zip->read(zip->entries()[0]);
    ASSERT_FALSE(data);
    EXPECT_THAT(data.error().message, HasSubstr("checksum"));
}

TEST(Zip, CutOrForeignFilesAreErrors) {
    const Scratch scratch;
    const std::string whole = zip_of({{"a.png", std::string(500, 'a'), 0, 0}});
    for (std::size_t cut = 0; cut < whole.size(); cut += 7) {
        write(scratch.at("cut.zip"), whole.substr(0, cut));
        EXPECT_FALSE(ZipReader::open(scratch.at("cut.zip"))) << cut;
    }
    write(scratch.at("text.zip"), std::string(3000, 'z'));
    EXPECT_FALSE(ZipReader::open(scratch.at("text.zip")));
    EXPECT_FALSE(ZipReader::open(scratch.at("none.zip")));
}

TEST(Zip, DamageAnywhereIsAnErrorOrHarmless) {
    const Scratch scratch;
    const std::string whole =
        zip_of({{"a.png", std::string(60, 'a'), 0, 0}, {"b.png", std::string(60, 'b'), 0, 0}});
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ 0xff);
        write(scratch.at("x.zip"), bytes);
        auto zip = ZipReader::open(scratch.at("x.zip"));
        if (!zip) continue;
        for (const ZipEntry& entry : zip->entries()) {
            EXPECT_TRUE(is_safe_path(entry.path));
            (void)zip->read(entry);
        }
    }
}

// A PNG whose header claims a size.
std::string png_claiming(std::uint32_t width, std::uint32_t height) {
    const auto bytes = encode_png(ImageU8x3(8, 8, 100));
    std::string png(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (int i = 0; i < 4; ++i) {
        png[static_cast<std::size_t>(16 + i)] = static_cast<char>(width >> (24 - 8 * i) & 255u);
        png[static_cast<std::size_t>(20 + i)] = static_cast<char>(height >> (24 - 8 * i) & 255u);
    }
    return png;
}

TEST(Pictures, HugeOnesAreRefusedByTheirHeader) {
    const Scratch scratch;
    // A TGA has no checksum over its header: 30,000 × 30,000 of 24 bits.
    write(scratch.at("huge.tga"), std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) + number(30'000, 2) +
                                      number(30'000, 2) + number(24, 1) + number(0, 1));
    const auto huge = read_picture_file(scratch.at("huge.tga"));
    ASSERT_FALSE(huge);
    EXPECT_THAT(huge.error().message, HasSubstr("30000x30000"));
}

TEST(Pictures, ThatLieOrAreCutAreErrors) {
    const Scratch scratch;
    write(scratch.at("lie.png"), png_claiming(60'000, 60'000));
    EXPECT_FALSE(read_picture_file(scratch.at("lie.png")));
    const std::string lying = png_claiming(60'000, 60'000);
    EXPECT_FALSE(decode_picture(std::as_bytes(std::span(lying))));
    write(scratch.at("lie.tga"), std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) + number(8000, 2) +
                                     number(8000, 2) + number(24, 1) + number(0, 1) + "abc");
    const auto lie = read_picture_file(scratch.at("lie.tga"));
    ASSERT_FALSE(lie);
    EXPECT_EQ(lie.error().code, ErrorCode::kUnreadable);
    write(scratch.at("empty.png"), "");
    EXPECT_FALSE(read_picture_file(scratch.at("empty.png")));
    write(scratch.at("text.jpg"), "no picture");
    EXPECT_FALSE(read_picture_file(scratch.at("text.jpg")));
}

TEST(Packages, NamesAreNotTrusted) {
    for (const char* name : {"", "../x", "a b", "-oDebug=1", "a;rm", "a/b"}) {
        const auto info = find_package_info(name);
        ASSERT_FALSE(info) << name;
        EXPECT_EQ(info.error().code, ErrorCode::kUsage) << name;
    }
}

TEST(Packages, AProgramThatFailsOrIsMissingIsAnError) {
    const auto missing = run_program({"weft-no-such-program"}, {}, {});
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, HasSubstr("not installed"));
    EXPECT_FALSE(run_program({"false"}, {}, {}));
    EXPECT_EQ(*run_program({"echo", "a b"}, {}, {}), "a b\n");
    const CancelToken cancel;
    cancel.cancel(130);
    const auto stopped = run_program({"sleep", "20"}, {}, cancel);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(exit_code(stopped.error().code), 130);
}

}  // namespace
}  // namespace weft
