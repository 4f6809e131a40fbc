#pragma once
#include <string>
#include <vector>

#include "app/project/project.h"

namespace weft {

/// Sets the files of a region's Cryptomatte to the plate's if the project names none. Errors: Usage
/// when the plate is not an image file or pattern.
[[nodiscard]] Status name_crypto_files(Region& region, const std::string& plate);

/// Whether each Cryptomatte object that the region names is in one of the `frames` of its files at
/// least. For a region after name_crypto_files(). Errors: as check_cryptomatte_names().
[[nodiscard]] Status check_crypto_names(const Region& region, const std::vector<int>& frames);

}  // namespace weft
