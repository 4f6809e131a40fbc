#pragma once
// Internal: the one place where OpenImageIO opens a picture for reading.

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

#include "engine/core/error.h"

namespace weft {

/// Errors: Unreadable when it is not a regular file, is empty, or is an EXR whose header cannot be
/// (engine/media/exr_header.h).
[[nodiscard]] Status check_picture_file(const std::string& path);

/// The file, opened by the reader that its first bytes ask for, whatever its extension. Left to
/// itself, OpenImageIO hands a file of unknown kind to all its readers in turn: that of DICOM reads
/// an endless file to its end, and that of FFmpeg follows play lists to other files. Thread-safe.
/// Errors: those of check_picture_file(); Unreadable when it is of no known kind or damaged.
[[nodiscard]] Expected<std::unique_ptr<OIIO::ImageInput>> open_picture(
    const std::string& path, const OIIO::ImageSpec& config = {});

}  // namespace weft
