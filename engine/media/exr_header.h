#pragma once
// Internal: what an EXR's header claims, checked before OpenEXR believes it.

#include <string>

#include "engine/core/error.h"

namespace weft {

/// Walks the attributes of all headers. OpenEXR 3.1 allocates what an attribute's size says, up to
/// 2 GB, before it reads: a size beyond the end of the file is refused here. Files that are not EXR
/// are left to the decoder. Errors: Unreadable.
[[nodiscard]] Status check_exr_header(const std::string& path);

}  // namespace weft
