#pragma once
// The colour information of a file.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace weft {

/// `space`: how values are read if no space is set: "srgb", "linear" or "cineon". `note`: what the
/// file says beyond `space`, to follow the file's name in a sentence ("has the ICC profile 'Adobe
/// RGB (1998)'"); empty: nothing.
struct FileColor {
    std::string space = "srgb";
    std::string note;
};

/// Internal: the name in an ICC profile (its tag 'desc', version 2 or 4); empty when it has none.
[[nodiscard]] std::string icc_profile_name(const unsigned char* profile, std::size_t bytes);
/// Internal: the note for a profile of this name; empty for sRGB.
[[nodiscard]] std::string note_of_profile(const std::string& name);
/// Internal: the note for red, green, blue and white in CIE xy; empty for Rec.709 with D65.
[[nodiscard]] std::string note_of_primaries(const std::array<double, 8>& xy);
/// Internal: the note for an encoding exponent; empty for that of displays (1/2.2).
[[nodiscard]] std::string note_of_gamma(double exponent);

}  // namespace weft
