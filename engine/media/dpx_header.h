#pragma once
// Internal: checks a DPX header against the file's length.

#include <string>

#include "engine/core/error.h"

namespace weft {

/// OpenImageIO 2.4 reads the missing rest of a DPX of 10 or 12 bits as zeros, without an error.
/// Accepts files that are not DPX, are compressed, or are stored in a way that is not supported
/// here. Errors: Unreadable if the file is shorter than its pixels.
[[nodiscard]] Status check_dpx_length(const std::string& path);

}  // namespace weft
