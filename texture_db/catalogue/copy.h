#pragma once
// Copies the content of one library into another.

#include <string>

#include "engine/core/error.h"

namespace weft {

class Database;

/// TextureLibrary::copy_from(). The caller holds the library's lock.
[[nodiscard]] Expected<bool> copy_library(Database& database, const std::string& path,
                                          const std::string& key, const std::string& value);

}  // namespace weft
