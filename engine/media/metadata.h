#pragma once
// Texts in the headers of picture files.

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// What write_image() put there of WriteOptions::metadata, by name. An EXR holds every text under
/// its own name; other formats hold them in the text "Software", as "weft VERSION name=value …" for
/// what fits, and textures and licences in "Copyright". Empty when the file cannot be read.
[[nodiscard]] std::map<std::string, std::string> read_recipe_metadata(const std::string& path);

/// Internal: the text for "Software" of formats without names of their own, and back.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] std::string software_text(const NamedTexts& metadata);
[[nodiscard]] std::string copyright_text(const NamedTexts& metadata);

}  // namespace weft
