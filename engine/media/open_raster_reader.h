#pragma once
// Internal: the picture that a layered document shows, from an archive that anyone may have
// written.

#include <string>

#include "engine/media/raster.h"

namespace weft {

/// True if the file begins as a zip archive does.
[[nodiscard]] bool is_zip(const std::string& path);

/// The merged picture of an OpenRaster file or a Krita document (mergedimage.png; nothing else is
/// looked at, and nothing is unpacked to the disk). Errors: Unreadable (no such archive, damaged,
/// another document, one without that picture), NoSpace.
[[nodiscard]] Expected<RasterInfo> probe_layered(const std::string& path);
[[nodiscard]] Expected<Raster> read_layered(const std::string& path);

}  // namespace weft
