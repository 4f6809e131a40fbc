#pragma once
// Internal: the only place where OpenImageIO opens a picture for reading.

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"

namespace weft {

/// Errors: Unreadable if it is not a regular file, is empty, or is an EXR with an invalid header
/// (engine/media/exr_header.h).
[[nodiscard]] Status check_picture_file(const std::string& path);

/// Opens the file with the reader that its first bytes require, whatever its extension. By default
/// OpenImageIO tries all its readers on a file of unknown kind: that of DICOM reads an endless file
/// to its end, and that of FFmpeg follows play lists to other files. Thread-safe. Errors: those of
/// check_picture_file(); Unreadable if its kind is unknown, it is damaged, a TIFF with several
/// pages or layers, an animation, or a PSD of a colour mode that OpenImageIO does not read right.
[[nodiscard]] Expected<std::unique_ptr<OIIO::ImageInput>> open_picture(
    const std::string& path, const OIIO::ImageSpec& config = {});

/// The views of an EXR part with several, or of several parts with one each, the default one first.
/// None for other files. Moves between parts.
[[nodiscard]] std::vector<std::string> list_views(OIIO::ImageInput& input);

}  // namespace weft
