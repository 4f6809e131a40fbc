#include <filesystem>

#include "engine/media/movies.h"

namespace weft {

Status check_movie(const std::string& path, double fps) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension != ".mp4" && extension != ".mkv")
        return fail(ErrorCode::kUsage, path + ": unknown kind of movie.", "Use .mp4 or .mkv.");
    constexpr double kMinFps = 0.01, kMaxFps = 1000;
    if (!(fps >= kMinFps && fps <= kMaxFps))
        return fail(ErrorCode::kUsage, path + ": a movie needs a frame rate of 0.01 to 1000.");
    return {};
}

}  // namespace weft
