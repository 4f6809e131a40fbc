#pragma once
// Picture files for the texture library.

#include <string>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// A picture file as 8-bit sRGB; floating-point files are read as linear. Rejects pictures of more
/// than `max_pixels` by their header, before memory is allocated. Errors: Unreadable, NoSpace.
[[nodiscard]] Expected<ImageU8x3> read_picture_file(const std::string& path,
                                                    long long max_pixels = 144'000'000);

}  // namespace weft
