#pragma once
// Opens a file that was just written, to check it.

#include <cstdint>
#include <span>
#include <string>

#include "engine/core/error.h"
#include "engine/core/geometry.h"

namespace weft {

/// A part of a picture file, as passed to the encoder.
struct WrittenPart {
    Size size;  ///< Of the data window.
    int channels = 0;
};

/// RenderFailed: `path` was not written, because the new file `how` ("cannot be opened").
[[nodiscard]] Error read_back_error(const std::string& path, const std::string& how);

/// Opens `file`, the temporary of `path`, and compares the number of parts, their sizes and their
/// channels. Of an EXR, whose parts are written one after the other, it also reads each part's last
/// rows. Errors: RenderFailed, naming `path`.
[[nodiscard]] Status check_written_picture(const std::string& file, const std::string& path,
                                           std::span<const WrittenPart> parts);

/// The same for a movie: one video stream of this size with this number of frames.
[[nodiscard]] Status check_written_movie(const std::string& file, const std::string& path,
                                         Size size, std::int64_t frames);

/// Returns true if the movie could be a review movie that Weft wrote for pictures of `size`: one
/// stream, of the size and with the colour tags or the codec that open_movie() gives it. Never in a
/// build without movies.
[[nodiscard]] bool is_review_movie(const std::string& file, Size size);

}  // namespace weft
