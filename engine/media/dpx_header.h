#pragma once
// Internal: checks a DPX header against the file's length.

#include <string>

#include "engine/core/error.h"

namespace weft {

/// OpenImageIO 2.4 reads two kinds of DPX wrongly without an error: the missing rest of one of 10
/// or 12 bits as zeros, and one whose lines are filled to four bytes without the header saying so
/// (ffmpeg 5.1 writes 8 bits so where a line needs it) sheared. Accepts files that are not DPX, are
/// compressed, or are stored in a way that is not supported here. Errors: Unreadable if the file is
/// shorter than its pixels, or longer by just that filling.
[[nodiscard]] Status check_dpx_layout(const std::string& path);

}  // namespace weft
