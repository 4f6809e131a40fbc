#include "engine/media/frame_reader.h"

#include <filesystem>
#include <system_error>

#include "engine/media/plates.h"
#include "engine/media/raster_errors.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

Expected<std::shared_ptr<const FrameReader>> open_plate(const std::string& path,
                                                        const ReadOptions& options) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        WEFT_TRY(pattern, find_sequence(path));
        return open_still_sequence(pattern, options);
    }
    const bool exists = std::filesystem::exists(path, ignored);
    if (has_movie_extension(path) && (exists || path.find_first_of("#@%") == std::string::npos)) {
        return open_movie_plate(path, options);
    }
    if (!exists) {
        WEFT_TRY(pattern, SequencePattern::parse(path));
        if (!pattern.is_single()) return open_still_sequence(pattern, options);
        return fail(ErrorCode::kMissingFrames, path + " not found.",
                    "Give a pattern such as plate.####.exr or a movie.");
    }
    if (!has_picture_extension(path)) {
        return tl::unexpected(unreadable(path, "it is neither a picture nor a movie by its name",
                                         "Give a pattern such as plate.####.exr or a movie."));
    }
    return open_still_sequence(SequencePattern::single(path), options);
}

}  // namespace weft
