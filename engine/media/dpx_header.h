#pragma once
// Internal: what a DPX's header claims, checked against the file's length.

#include <string>

#include "engine/core/error.h"

namespace weft {

/// OpenImageIO 2.4 reads the missing rest of a DPX of 10 or 12 bits as zeros, without a word. Files
/// that are no DPX, are compressed, or are stored in a way that is not known here pass. Errors:
/// Unreadable when the file is shorter than its pixels.
[[nodiscard]] Status check_dpx_length(const std::string& path);

}  // namespace weft
