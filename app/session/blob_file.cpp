#include "app/session/blob_file.h"

#include <zlib.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "engine/core/hash.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

// Before the compressed bytes.
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
    Bytes packed(size);
    compress2(packed.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), 1);
    const Hash128 check = checksum(bytes);
    Header header;
    header.raw_bytes = bytes.size();
    header.check_high = check.high;
    header.check_low = check.low;
    WEFT_TRY(temporary, TemporaryFile::create(path));
    std::ofstream file(temporary.name(), std::ios::binary);
    file.write(reinterpret_cast<const char*>(&header), sizeof header);
    file.write(reinterpret_cast<const char*>(packed.data()), static_cast<std::streamsize>(size));
    file.close();
    if (!file) return fail(ErrorCode::kNoSpace, path + " cannot be written. Free disk space.");
    return temporary.commit_unflushed();
}

std::optional<Bytes> read_blob(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    Header header;
    const Header expected;
    file.read(reinterpret_cast<char*>(&header), sizeof header);
    constexpr std::uint64_t kLargest = 1ull << 32;
    if (!file || std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0 ||
        header.raw_bytes > kLargest) {
        return std::nullopt;
    }
    const Bytes packed{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    Bytes bytes(header.raw_bytes);
    auto size = static_cast<uLongf>(bytes.size());
    const bool unpacked =
        uncompress(bytes.data(), &size, packed.data(), static_cast<uLong>(packed.size())) == Z_OK;
    const Hash128 check = checksum(bytes);
    if (!unpacked || size != bytes.size() || check.high != header.check_high ||
        check.low != header.check_low) {
        return std::nullopt;
    }
    return bytes;
}

}  // namespace weft
