#pragma once
// Internal: the two kinds of plate behind open_plate().

#include <memory>
#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/media/frame_reader.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

[[nodiscard]] Expected<std::shared_ptr<const FrameReader>> open_still_sequence(
    const SequencePattern& pattern, const ReadOptions& options);
[[nodiscard]] Expected<std::shared_ptr<const FrameReader>> open_movie_plate(
    const std::string& path, const ReadOptions& options);

/// The only numbered sequence of pictures in a folder. Errors: Usage if there are several (the
/// message lists them), MissingFrames if there is none, Unreadable folder.
[[nodiscard]] Expected<SequencePattern> find_sequence(const std::string& folder);

/// The last number in a file name (plate.-0012.exr: -12), if there is one.
[[nodiscard]] std::optional<int> number_in_name(const std::string& path);

/// By extension, ignoring case: a movie container; a picture.
[[nodiscard]] bool has_movie_extension(const std::string& path);
[[nodiscard]] bool has_picture_extension(const std::string& path);

/// Hash of a file's path and FileStamp, and of a number for frames of one file.
[[nodiscard]] Expected<Hash128> stamp_file(const std::string& path, int frame);

}  // namespace weft
