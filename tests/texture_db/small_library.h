#pragma once
// A library with some starter textures of every family, made once for a test program.

#include <memory>

#include "texture_db/library/library.h"

namespace weft {

/// Null when it cannot be made. Do not change it.
[[nodiscard]] std::shared_ptr<TextureLibrary> small_library();

}  // namespace weft
