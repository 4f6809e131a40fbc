#pragma once
#include <string>

#include "app/project/project.h"

namespace weft {

/// Names the files of a region's Cryptomatte objects where the project does not: the plate's.
/// Errors: Usage when the plate is not a pattern or file that could have one.
[[nodiscard]] Status name_crypto_files(Region& region, const std::string& plate);

}  // namespace weft
