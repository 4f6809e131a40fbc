#pragma once
// Text entries in the headers of picture files.

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// The entries of WriteOptions::metadata that write_image() stored, by name. An EXR has each under
/// its own name. Other formats store what fits in "Software", as "weft VERSION name=value …", the
/// inputs there too, in DPX in "DocumentName", and textures and licences in "Copyright". Empty if
/// the file cannot be read.
[[nodiscard]] std::map<std::string, std::string> read_recipe_metadata(const std::string& path);

/// Internal: the text for "Software" of formats without names of their own, and back.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] std::string software_text(const NamedTexts& metadata, bool with_inputs = true);
/// The inputs alone, for DPX; empty without them.
[[nodiscard]] std::string inputs_text(const NamedTexts& metadata);
[[nodiscard]] std::string copyright_text(const NamedTexts& metadata);

}  // namespace weft
