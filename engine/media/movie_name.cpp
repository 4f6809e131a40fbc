#include <filesystem>

#include "engine/media/movies.h"

namespace weft {

Status check_movie_name(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension == ".mp4" || extension == ".mkv") return {};
    return fail(ErrorCode::kUsage, path + ": unknown kind of movie. Use .mp4 or .mkv.");
}

}  // namespace weft
