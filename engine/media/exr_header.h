#pragma once
// Internal: checks the sizes in an EXR header before OpenEXR uses them.

#include <string>

#include "engine/core/error.h"

namespace weft {

/// Checks the attributes of all headers. OpenEXR 3.1 allocates the claimed size of an attribute, up
/// to 2 GB, before it reads; a size beyond the end of the file is rejected here. Files that are not
/// EXR are left to the decoder. Errors: Unreadable.
[[nodiscard]] Status check_exr_header(const std::string& path);

}  // namespace weft
