// Files that lie, climb, burst or are cut short.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/media/zip_reader.h"
#include "tests/texture_db/scratch.h"
#include "texture_db/describe/picture_file.h"
#include "texture_db/describe/sample_codec.h"
#include "texture_db/sources/packages.h"

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
    std::uint32_t flags = 0, method = 0;
};

std::string long_number(std::uint64_t v) {
    return number(static_cast<std::uint32_t>(v), 4) +
           number(static_cast<std::uint32_t>(v >> 32), 4);
}

// The two records by which zip64 counts its entries in 64 bits, and then the end record.
std::string zip64_end(std::uint64_t count, std::uint64_t bytes, std::uint64_t offset) {
    return number(0x06064b50, 4) + long_number(44) + number(45, 2) + number(45, 2) + number(0, 4) +
           number(0, 4) + long_number(count) + long_number(count) + long_number(bytes) +
           long_number(offset) + number(0x07064b50, 4) + number(0, 4) +
           long_number(offset + bytes) + number(1, 4) + number(0x06054b50, 4) + number(0, 4) +
           number(0xffff, 2) + number(0xffff, 2) + number(0xffffffff, 4) + number(0xffffffff, 4) +
           number(0, 2);
}

struct ZipParts {
    std::string members, directory;
};

// Stored (not packed) members.
ZipParts zip_parts(const std::vector<Member>& members) {
    std::string out, directory;
    for (const Member& m : members) {
        const auto size = static_cast<std::uint32_t>(m.data.size());
        const std::uint32_t claimed = m.claimed_bytes ? m.claimed_bytes : size;
        const std::string common =
            number(20, 2) + number(m.flags, 2) + number(m.method, 2) + number(0, 4) +
            number(m.crc, 4) + number(size, 4) + number(claimed, 4) +
            number(static_cast<std::uint32_t>(m.path.size()), 2) + number(0, 2);
        directory += number(0x02014b50, 4) + number(20, 2) + common + number(0, 2) + number(0, 2) +
                     number(0, 2) + number(0, 4) +
                     number(static_cast<std::uint32_t>(out.size()), 4) + m.path;
        out += number(0x04034b50, 4) + common + m.path + m.data;
    }
    return {out, directory};
}

std::string zip_of(const std::vector<Member>& members) {
    const auto [out, directory] = zip_parts(members);
    const auto offset = static_cast<std::uint32_t>(out.size()),
               count = static_cast<std::uint32_t>(members.size());
    return out + directory + number(0x06054b50, 4) + number(0, 4) + number(count, 2) +
           number(count, 2) + number(static_cast<std::uint32_t>(directory.size()), 4) +
           number(offset, 4) + number(0, 2);
}

TEST(Zip, PathsThatClimbOutAreRefused) {
    const Scratch scratch;
    write_file(scratch.at("a.zip"), zip_of({{"good/wood.png", "x", 0, 0},
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
    write_file(scratch.at("a.zip"), zip_of({{"bomb.png", "x", 4'000'000'000u, 0},
                                            {"wrong.png", "data", 0, 0x12345678}}));
    auto zip = ZipReader::open(scratch.at("a.zip"));
    ASSERT_TRUE(zip);
    EXPECT_THAT(zip->refused(), testing::ElementsAre("bomb.png"));
    ASSERT_EQ(zip->entries().size(), 1u);
    const auto data = zip->read(zip->entries()[0]);
    ASSERT_FALSE(data);
    EXPECT_THAT(data.error().sentence(), HasSubstr("checksum"));
}

TEST(Zip, MoreThan65535EntriesAreAllRead) {
    const Scratch scratch;
    std::vector<Member> members;
    for (int i = 0; i < 70'000; ++i)
        members.push_back({"t/" + std::to_string(i) + ".png", "", 0, 0});
    members.push_back({"last.png", "abc", 0, 0x352441c2});
    const auto [out, directory] = zip_parts(members);
    write_file(scratch.at("many.zip"),
               out + directory + zip64_end(members.size(), directory.size(), out.size()));
    auto zip = ZipReader::open(scratch.at("many.zip"));
    ASSERT_TRUE(zip) << zip.error().text();
    ASSERT_EQ(zip->entries().size(), members.size());
    EXPECT_EQ(zip->entries()[69'999].path, "t/69999.png");
    const auto data = zip->read(zip->entries().back());
    ASSERT_TRUE(data) << data.error().text();
    EXPECT_EQ(*data, "abc");
}

TEST(Zip, CountsThatCannotBeTrueAreErrors) {
    const Scratch scratch;
    const auto [out, directory] = zip_parts({{"a.png", "abc", 0, 0x352441c2}});
    // The larger ones would take gigabytes if anybody made room for them.
    for (const std::uint64_t count :
         {std::uint64_t{2}, std::uint64_t{2'000'000}, std::uint64_t{1} << 28,
          std::uint64_t{1} << 31, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
        write_file(scratch.at("lie.zip"),
                   out + directory + zip64_end(count, directory.size(), out.size()));
        EXPECT_FALSE(ZipReader::open(scratch.at("lie.zip"))) << count;
    }
    for (const std::uint64_t offset : {std::uint64_t{1} << 40, ~std::uint64_t{0} - 60}) {
        write_file(scratch.at("lie.zip"), out + directory + zip64_end(1, directory.size(), offset));
        EXPECT_FALSE(ZipReader::open(scratch.at("lie.zip"))) << offset;
    }
}

TEST(Zip, EncryptedAndStrangelyPackedEntriesAreRefused) {
    const Scratch scratch;
    constexpr std::uint32_t kEncrypted = 1, kBzip2 = 12, kZstd = 93;
    write_file(scratch.at("a.zip"), zip_of({{"plain.png", "abc", 0, 0x352441c2},
                                            {"secret.png", "abc", 0, 0x352441c2, kEncrypted, 0},
                                            {"bzip2.png", "abc", 0, 0x352441c2, 0, kBzip2},
                                            {"zstd.png", "abc", 0, 0x352441c2, 0, kZstd}}));
    auto zip = ZipReader::open(scratch.at("a.zip"));
    ASSERT_TRUE(zip) << zip.error().text();
    EXPECT_THAT(zip->refused(), testing::ElementsAre("secret.png", "bzip2.png", "zstd.png"));
    ASSERT_EQ(zip->entries().size(), 1u);
    EXPECT_EQ(zip->read(zip->entries()[0]).value_or(""), "abc");
}

// What is stored is shorter, or longer, than the table of contents says.
TEST(Zip, WrongSizesAreErrorsWhenRead) {
    const Scratch scratch;
    for (const std::uint32_t claimed : {2u, 4u, 400u}) {
        write_file(scratch.at("a.zip"), zip_of({{"a.png", "abc", claimed, 0x352441c2}}));
        auto zip = ZipReader::open(scratch.at("a.zip"));
        if (!zip) continue;
        for (const ZipEntry& entry : zip->entries()) {
            const auto data = zip->read(entry);
            ASSERT_FALSE(data) << claimed;
            EXPECT_EQ(data.error().code, ErrorCode::kUnreadable);
        }
    }
}

TEST(Zip, CutOrForeignFilesAreErrors) {
    const Scratch scratch;
    const std::string whole = zip_of({{"a.png", std::string(500, 'a'), 0, 0}});
    for (std::size_t cut = 0; cut < whole.size(); cut += 7) {
        write_file(scratch.at("cut.zip"), whole.substr(0, cut));
        EXPECT_FALSE(ZipReader::open(scratch.at("cut.zip"))) << cut;
    }
    write_file(scratch.at("text.zip"), std::string(3000, 'z'));
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
        write_file(scratch.at("x.zip"), bytes);
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
    write_file(scratch.at("huge.tga"), std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) +
                                           number(30'000, 2) + number(30'000, 2) + number(24, 1) +
                                           number(0, 1));
    const auto huge = read_picture_file(scratch.at("huge.tga"));
    ASSERT_FALSE(huge);
    EXPECT_THAT(huge.error().sentence(), HasSubstr("30000x30000"));
}

TEST(Pictures, ThatLieOrAreCutAreErrors) {
    const Scratch scratch;
    write_file(scratch.at("lie.png"), png_claiming(60'000, 60'000));
    EXPECT_FALSE(read_picture_file(scratch.at("lie.png")));
    const std::string lying = png_claiming(60'000, 60'000);
    EXPECT_FALSE(decode_picture(std::as_bytes(std::span(lying))));
    write_file(scratch.at("lie.tga"), std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) +
                                          number(8000, 2) + number(8000, 2) + number(24, 1) +
                                          number(0, 1) + "abc");
    const auto lie = read_picture_file(scratch.at("lie.tga"));
    ASSERT_FALSE(lie);
    EXPECT_EQ(lie.error().code, ErrorCode::kUnreadable);
    write_file(scratch.at("empty.png"), "");
    EXPECT_FALSE(read_picture_file(scratch.at("empty.png")));
    write_file(scratch.at("text.jpg"), "no picture");
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
    EXPECT_THAT(missing.error().sentence(), HasSubstr("not installed"));
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
