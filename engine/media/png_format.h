#pragma once
// Internal: what the PNG writer and the reader of plain PNG share: how pixels lie in a file, and
// row filters (PNG 1.2, chapters 2, 3 and 6).

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/core/geometry.h"
#include "engine/media/big_endian.h"

namespace weft {

/// Every picture that is written, and those that read_plain_png() takes: 8 or 16 bits, grey or RGB
/// with or without alpha, not interlaced.
struct PngShape {
    Size size;
    int channels = 0;          ///< 1 to 4.
    int bytes_per_sample = 0;  ///< 1 or 2; 2 with the most significant byte first.

    [[nodiscard]] std::size_t pixel_bytes() const {
        return static_cast<std::size_t>(channels) * static_cast<std::size_t>(bytes_per_sample);
    }
    [[nodiscard]] std::size_t row_bytes() const {
        return pixel_bytes() * static_cast<std::size_t>(size.width);
    }
    /// Of all rows, each behind the byte that names its filter: what is compressed.
    [[nodiscard]] std::size_t filtered_bytes() const {
        return (row_bytes() + 1) * static_cast<std::size_t>(size.height);
    }
};

inline constexpr std::string_view kPngSignature{"\x89PNG\r\n\x1a\n", 8};
/// A chunk's length and name in front of its data, and the checksum behind it.
inline constexpr std::size_t kPngChunkHead = 8, kPngChunkTail = 4;

/// Filters `row` by Sub or Up, whichever leaves the smaller sum of differences, into `to`: the
/// filter's byte, then as many bytes as the row has. `above` is the row before it, or null for the
/// first row.
void filter_png_row(const unsigned char* row, const unsigned char* above, std::size_t bytes,
                    std::size_t pixel_bytes, unsigned char* to);

/// Undoes the filters of all rows in place and moves the rows together: afterwards the first
/// row_bytes() * height bytes of `filtered` are the picture. Returns false, with the content
/// undefined, if a row names an unknown filter. `filtered` has filtered_bytes().
[[nodiscard]] bool unfilter_png(const PngShape& shape, unsigned char* filtered);

}  // namespace weft
