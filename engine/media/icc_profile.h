#pragma once
// Internal: ICC profiles in pictures.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/media/file_color.h"

namespace weft {

/// The bytes of the profile's tag of this signature (ICC.1:2010, 7.2 and 7.3); empty without one.
[[nodiscard]] std::span<const unsigned char> icc_tag(const unsigned char* profile,
                                                     std::size_t bytes, std::string_view signature);

/// The profile of a WebP, which OpenImageIO 2.4 does not read; empty without one, or for another
/// kind of file.
[[nodiscard]] std::vector<unsigned char> profile_of_webp(const std::string& path);

/// What a file with this profile says if its values are else read as `by_type`. The profile's curve
/// decides between "srgb" and "linear"; a note tells of it where it differs.
[[nodiscard]] FileColor color_of_profile(const unsigned char* profile, std::size_t bytes,
                                         const std::string& by_type);

}  // namespace weft
