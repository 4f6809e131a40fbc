#pragma once
// Internal: the pixels of plain PNG files, which nearly all plates are, without zlib.

#include <cstdint>
#include <span>

#include "engine/core/input_file.h"
#include "engine/media/png_format.h"

namespace weft {

/// Reads the pixels of a file whose first IDAT chunk begins at `offset`. `to` has
/// shape.filtered_bytes(); afterwards its beginning holds the rows as they lie in the file, 16-bit
/// samples most significant byte first. Returns false, with the content of `to` undefined, if
/// anything in the rest of the file is damaged or unusual: libpng then reads it and decides. Takes
/// no more memory than the shape needs, whatever the file claims.
[[nodiscard]] bool read_plain_png(const InputFile& file, std::uint64_t offset,
                                  const PngShape& shape, std::span<unsigned char> to);

}  // namespace weft
