#pragma once
// Whether this build reads and writes movies. CMake's WEFT_MOVIES decides; without it
// open_plate() and open_movie() refuse movies (NoBackend), and everything else works.

#include <string>

#include "engine/core/error.h"

namespace weft {

/// The library behind movies, its version and the licence that it was built under, such as
/// "FFmpeg's libavcodec 59.37.100, GPL version 2 or later"; empty in a build without movies.
[[nodiscard]] std::string movie_library();

/// Errors: NoBackend in a build without movies, in words that name `path`.
[[nodiscard]] Status require_movies(const std::string& path);

}  // namespace weft
