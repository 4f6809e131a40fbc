#pragma once
// Whether this build supports movies (CMake's WEFT_MOVIES). Without it open_plate() and
// open_movie() reject movies (NoBackend), and everything else works.

#include <string>

#include "engine/core/error.h"

namespace weft {

/// The movie library with version and licence, such as "FFmpeg's libavcodec 59.37.100, GPL version
/// 2 or later"; empty in a build without movies.
[[nodiscard]] std::string movie_library();

/// Errors: NoBackend in a build without movies; the message names `path`.
[[nodiscard]] Status require_movies(const std::string& path);
/// Errors: Usage when the extension is not that of a movie that can be written (.mp4, .mkv), or the
/// frame rate is not 0.01 to 1000 per second.
[[nodiscard]] Status check_movie(const std::string& path, double fps);

}  // namespace weft
