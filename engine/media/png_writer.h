#pragma once
// Internal: encodes PNG. With libdeflate, which takes half of zlib's time for files that are no
// larger (docs/decisions/0006-png-and-movies.md).

#include <cstddef>
#include <memory>
#include <span>

#include "engine/media/encode.h"

namespace weft {

/// A file in memory. Not a vector, which would first fill it with zeros.
struct EncodedFile {
    std::unique_ptr<unsigned char[]> data;
    std::size_t size = 0;
    [[nodiscard]] std::span<const std::byte> bytes() const {
        return std::as_bytes(std::span(data.get(), size));
    }
};

inline constexpr std::size_t kLargestPngChunk = 0x7fffffff;

/// `samples` are kU8 or kU16. The bytes do not depend on the number of threads. Pixels lie in one
/// chunk unless they take more than `largest_chunk` (larger than PNG allows). Throws
/// std::bad_alloc.
[[nodiscard]] EncodedFile encode_png(const Samples& samples, const WriteOptions& options,
                                     std::size_t largest_chunk = kLargestPngChunk);

}  // namespace weft
