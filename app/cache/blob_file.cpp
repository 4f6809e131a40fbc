#include "app/cache/blob_file.h"

#include <zlib.h>

#include <cstring>
#include <fstream>

#include "engine/core/hash.h"
#include "engine/core/input_file.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

// Precedes the compressed bytes.
struct Header {
    char magic[8] = {'w', 'e', 'f', 't', 'b', 'l', 'b', '1'};
    std::uint64_t raw_bytes = 0;
    std::uint64_t check_high = 0, check_low = 0;
};

Hash128 checksum(const Bytes& bytes) {
    Hasher hasher;
    hasher.bytes(bytes.data(), bytes.size());
    return hasher.finish();
}

}  // namespace

Status write_blob(const std::string& path, const Bytes& bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::vector<std::byte> file(sizeof(Header) + size);
    compress2(reinterpret_cast<Bytef*>(file.data() + sizeof(Header)), &size, bytes.data(),
              static_cast<uLong>(bytes.size()), 1);
    file.resize(sizeof(Header) + size);
    const Hash128 check = checksum(bytes);
    Header header;
    header.raw_bytes = bytes.size();
    header.check_high = check.high;
    header.check_low = check.low;
    std::memcpy(file.data(), &header, sizeof header);
    WEFT_TRY(temporary, TemporaryFile::create(path, WriteRule::own()));
    WEFT_CHECK_OK(temporary.write(file));
    return temporary.commit_unflushed();
}

std::optional<Bytes> read_blob(const std::string& path) {
    constexpr std::uint64_t kLargest = 1ull << 32;
    const auto text = read_file(path, {}, kLargest);
    Header header;
    const Header expected;
    if (!text || text->size() < sizeof header) return std::nullopt;
    std::memcpy(&header, text->data(), sizeof header);
    if (std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0 ||
        header.raw_bytes > kLargest) {
        return std::nullopt;
    }
    Bytes bytes(header.raw_bytes);
    auto size = static_cast<uLongf>(bytes.size());
    const bool unpacked = uncompress(bytes.data(), &size,
                                     reinterpret_cast<const Bytef*>(text->data()) + sizeof header,
                                     static_cast<uLong>(text->size() - sizeof header)) == Z_OK;
    const Hash128 check = checksum(bytes);
    if (!unpacked || size != bytes.size() || check.high != header.check_high ||
        check.low != header.check_low) {
        return std::nullopt;
    }
    return bytes;
}

}  // namespace weft
