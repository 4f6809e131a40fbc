#pragma once
#include <string>

#include "app/project/project.h"

namespace weft {

/// Names the files of a region's Cryptomatte objects where the project does not: the plate's.
/// Errors: Usage when the plate is no pattern or file that could hold one.
[[nodiscard]] Status name_crypto_files(Region& region, const std::string& plate);

}  // namespace weft
