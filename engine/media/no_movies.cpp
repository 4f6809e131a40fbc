// Replaces the movie files in a build without FFmpeg.

#include <memory>
#include <string>

#include "engine/media/frame_writer.h"
#include "engine/media/movies.h"
#include "engine/media/plates.h"
#include "engine/media/read_back.h"

namespace weft {
std::string movie_library() {
    return {};
}

Status require_movies(const std::string& path) {
    return fail(ErrorCode::kNoBackend, path + ": this build has no movies (WEFT_MOVIES is off).",
                "Use numbered frames, or a build with movies.");
}

Expected<std::shared_ptr<const FrameReader>> open_movie_plate(const std::string& path,
                                                              const ReadOptions& /*options*/) {
    WEFT_CHECK_OK(stamp_file(path, 0));
    return tl::unexpected(require_movies(path).error());
}

Expected<std::unique_ptr<MovieWriter>> open_movie(const std::string& path, Size /*size*/,
                                                  double /*fps*/, double /*pixel_aspect*/,
                                                  const WriteRule& /*rule*/) {
    return tl::unexpected(require_movies(path).error());
}

bool is_review_movie(const std::string& /*file*/, Size /*size*/) {
    return false;
}

}  // namespace weft
