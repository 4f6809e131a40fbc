#pragma once
// Internal: the larger picture that a sample was cut from, where the library holds it by reference.

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "texture_db/catalogue/query.h"

namespace weft {

/// Procedural: made anew, larger. File: read from where it lay. Errors: Unreadable when the source
/// is gone or has another size than it had.
[[nodiscard]] Expected<ImageU8x3> read_source_picture(const TextureInfo& info);

}  // namespace weft
