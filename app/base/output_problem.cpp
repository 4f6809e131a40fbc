#include "app/base/output_problem.h"

#include "engine/media/frame_writer.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

std::optional<std::string> output_problem(const std::string& output, std::size_t frames) {
    if (output.empty()) return "Say where the frames are written, such as shots/####.png.";
    const auto pattern = SequencePattern::parse(output);
    if (!pattern) return pattern.error().text();
    WriteOptions options;
    options.depth = default_depth(output, options.depth);
    if (!check_format(output, options))
        return "The result is an image sequence: end the path with .png, .jpg, .tif, .exr or .dpx. "
               "For a movie as well, tick Write review movie.";
    if (pattern->is_single() && frames > 1)
        return "The path has no frame number. Write it like shots/####.png.";
    return std::nullopt;
}

}  // namespace weft
