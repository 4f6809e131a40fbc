#pragma once
// Internal: the larger picture that a sample was cut from, if the library refers to it.

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "texture_db/catalogue/query.h"

namespace weft {

/// Procedural textures are rendered again, larger; files are read from their path. Errors:
/// Unreadable if the source is missing or its size has changed.
[[nodiscard]] Expected<ImageU8x3> read_source_picture(const TextureInfo& info);

}  // namespace weft
