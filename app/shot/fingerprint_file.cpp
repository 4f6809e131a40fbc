#include "app/shot/fingerprint_file.h"

#include <array>
#include <cstring>
#include <span>
#include <vector>

#include "engine/core/byte_stream.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

constexpr std::array<char, 8> kMagic{'w', 'e', 'f', 't', 'f', 'p', 'r', '1'};
constexpr std::uint64_t kLargestFile_bytes = std::uint64_t{256} << 20;
constexpr std::uint64_t kSample_bytes = 4096;

Hash128 checksum(const std::uint8_t* data, std::size_t size) {
    Hasher hasher;
    return hasher.bytes(data, size).finish();
}

}  // namespace

Expected<Hash128> hash_of_sample(const std::string& path) {
    WEFT_TRY(file, InputFile::open(path));
    Hasher hasher;
    hasher.value(file.bytes());
    std::array<char, kSample_bytes> block{};
    const std::uint64_t last = file.bytes() > kSample_bytes ? file.bytes() - kSample_bytes : 0;
    for (const std::uint64_t offset : {std::uint64_t{0}, last / 2, last}) {
        WEFT_TRY(count, file.read_at(offset, block.data(), block.size()));
        hasher.bytes(block.data(), count);
    }
    return hasher.finish();
}

FolderFingerprints read_fingerprints(const std::string& path) {
    const auto text = read_file(path, {}, kLargestFile_bytes);
    if (!text || text->size() < sizeof(Hash128)) return {};
    const std::size_t size = text->size() - sizeof(Hash128);
    const auto* data = reinterpret_cast<const std::uint8_t*>(text->data());
    Hash128 check;
    std::memcpy(&check, data + size, sizeof check);
    if (check != checksum(data, size)) return {};
    const std::vector<std::uint8_t> bytes(data, data + size);
    ByteReader reader(bytes);
    std::array<char, 8> magic{};
    std::uint64_t count = 0;
    reader.value(magic).value(count);
    if (magic != kMagic) return {};
    FolderFingerprints out;
    for (std::uint64_t k = 0; k < count && reader.ok(); ++k) {
        std::uint32_t length = 0;
        reader.value(length);
        if (!reader.ok() || !reader.holds(length, 1)) return {};
        std::string name(length, '\0');
        Fingerprint one;
        reader.raw(name.data(), length);
        reader.value(one.stamp.bytes).value(one.stamp.modified_ns).value(one.stamp.changed_ns);
        Hash128 contents;
        std::uint8_t is_read = 0, settled = 0;
        reader.value(one.stamp.inode).value(one.sample).value(one.id).value(contents);
        reader.value(is_read).value(settled);
        if (is_read != 0) one.contents = contents;
        one.settled = settled != 0;
        out[std::move(name)] = one;
    }
    return reader.complete() ? out : FolderFingerprints();
}

Status write_fingerprints(const std::string& path, const FolderFingerprints& fingerprints) {
    ByteWriter writer;
    writer.value(kMagic).value(static_cast<std::uint64_t>(fingerprints.size()));
    for (const auto& [name, one] : fingerprints) {
        writer.value(static_cast<std::uint32_t>(name.size())).raw(name.data(), name.size());
        writer.value(one.stamp.bytes).value(one.stamp.modified_ns).value(one.stamp.changed_ns);
        writer.value(one.stamp.inode).value(one.sample).value(one.id);
        writer.value(one.contents.value_or(Hash128()));
        writer.value(static_cast<std::uint8_t>(one.contents.has_value()));
        writer.value(static_cast<std::uint8_t>(one.settled));
    }
    std::vector<std::uint8_t> bytes = writer.take();
    const Hash128 check = checksum(bytes.data(), bytes.size());
    const auto* tail = reinterpret_cast<const std::uint8_t*>(&check);
    bytes.insert(bytes.end(), tail, tail + sizeof check);
    WEFT_TRY(temporary, TemporaryFile::create(path, WriteRule::own()));
    WEFT_CHECK_OK(temporary.write(std::as_bytes(std::span(bytes))));
    return temporary.commit_unflushed();
}

}  // namespace weft
