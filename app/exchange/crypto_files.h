#pragma once
#include <string>

#include "app/project/project.h"

namespace weft {

/// Sets the files of a region's Cryptomatte to the plate's if the project names none. Errors: Usage
/// when the plate is not an image file or pattern.
[[nodiscard]] Status name_crypto_files(Region& region, const std::string& plate);

}  // namespace weft
