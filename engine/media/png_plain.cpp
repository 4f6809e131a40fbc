#include "engine/media/png_plain.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

namespace weft {
namespace {

struct FreeDecompressor {
    void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};
using Decompressor = std::unique_ptr<libdeflate_decompressor, FreeDecompressor>;

// A part of a file in memory.
struct Bytes {
    std::unique_ptr<unsigned char[]> data;
    std::size_t size = 0;
};

// The file from `offset` on, unless it is much larger than a compressed picture can be: compression
// adds a few bytes to each block at worst, and a writer may add a chunk around every few thousand.
std::optional<Bytes> rest_of(const InputFile& file, std::uint64_t offset, const PngShape& shape) {
    constexpr std::size_t kMost_overhead = 64 << 10;
    const std::size_t pixels = shape.filtered_bytes();
    if (offset > file.bytes() || file.bytes() - offset > pixels + pixels / 64 + kMost_overhead)
        return std::nullopt;
    Bytes rest;
    rest.size = static_cast<std::size_t>(file.bytes() - offset);
    rest.data = std::make_unique_for_overwrite<unsigned char[]>(rest.size);
    const auto got = file.read_at(offset, rest.data.get(), rest.size);
    if (!got || *got != rest.size) return std::nullopt;
    return rest;
}

struct Chunk {
    std::string_view name;
    unsigned char* data = nullptr;
    std::size_t bytes = 0;
};

// The chunk at `at`, if it is whole and its checksum is right.
std::optional<Chunk> chunk_at(const Bytes& file, std::size_t at) {
    constexpr std::size_t kFrame = kPngChunkHead + kPngChunkTail;
    if (at > file.size || file.size - at < kFrame) return std::nullopt;
    unsigned char* const head = file.data.get() + at;
    const std::size_t bytes = big_endian_u32(head);
    if (bytes > file.size - at - kFrame) return std::nullopt;
    const Chunk chunk{{reinterpret_cast<const char*>(head) + 4, 4}, head + kPngChunkHead, bytes};
    const std::uint32_t sum = libdeflate_crc32(0, head + 4, 4 + bytes);
    if (sum != big_endian_u32(chunk.data + bytes)) return std::nullopt;
    return chunk;
}

// Text and times behind the pixels do not change how they look; libpng may refuse large ones.
bool may_follow_pixels(const Chunk& chunk) {
    constexpr std::size_t kMost_bytes = 4096;
    return (chunk.name == "tEXt" || chunk.name == "tIME") && chunk.bytes <= kMost_bytes;
}

// Moves the data of all IDAT chunks to the beginning of `file` and returns how many bytes they are.
// Nothing unless the file ends as it should.
std::optional<std::size_t> join_pixels(const Bytes& file) {
    std::size_t at = 0, joined = 0;
    bool behind_pixels = false;
    for (int others = 0; others < 100;) {
        const auto chunk = chunk_at(file, at);
        if (!chunk) return std::nullopt;
        if (chunk->name == "IEND") return chunk->bytes == 0 ? std::optional(joined) : std::nullopt;
        if (chunk->name == "IDAT" && !behind_pixels) {
            std::memmove(file.data.get() + joined, chunk->data, chunk->bytes);
            joined += chunk->bytes;
        } else if (may_follow_pixels(*chunk)) {
            behind_pixels = true;
            ++others;
        } else {
            return std::nullopt;
        }
        at += kPngChunkHead + chunk->bytes + kPngChunkTail;
    }
    return std::nullopt;
}

// zlib refuses distances beyond the window that the stream declares, which libdeflate does not look
// at. No distance is larger than the picture.
bool reaches_back(const Bytes& file, std::size_t compressed, const PngShape& shape) {
    constexpr unsigned kLargest = 7;
    if (compressed < 2) return false;
    const unsigned declared = file.data[0] >> 4;
    return declared == kLargest ||
           (declared < kLargest && std::size_t{256} << declared >= shape.filtered_bytes());
}

}  // namespace

bool read_plain_png(const InputFile& file, std::uint64_t offset, const PngShape& shape,
                    std::span<unsigned char> to) {
    const auto rest = rest_of(file, offset, shape);
    if (!rest) return false;
    const auto compressed = join_pixels(*rest);
    const Decompressor decompressor(libdeflate_alloc_decompressor());
    if (!compressed || !decompressor || !reaches_back(*rest, *compressed, shape)) return false;
    std::size_t used = 0;
    // Without a place for the number of bytes it fails unless the picture is filled exactly.
    const libdeflate_result result =
        libdeflate_zlib_decompress_ex(decompressor.get(), rest->data.get(), *compressed, to.data(),
                                      shape.filtered_bytes(), &used, nullptr);
    if (result != LIBDEFLATE_SUCCESS || used != *compressed) return false;
    return unfilter_png(shape, to.data());
}

}  // namespace weft
