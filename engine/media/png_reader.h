#pragma once
// Internal: PNG through libpng directly, because the ids of a palette matte are indices, which
// OpenImageIO converts to colours, and because libpng's messages must reach the caller, not stderr.

#include <string>

#include "engine/core/input_file.h"
#include "engine/media/raster.h"

namespace weft {

/// True if the file begins with the PNG signature.
[[nodiscard]] bool is_png(const std::string& path);
[[nodiscard]] Expected<RasterInfo> probe_png(const std::string& path);
[[nodiscard]] Expected<Raster> read_png(const std::string& path, bool raw_codes);
/// The same of a file that is open, or in memory. `path` is for messages.
[[nodiscard]] Expected<RasterInfo> probe_png(const InputFile& file, const std::string& path);
[[nodiscard]] Expected<Raster> read_png(const InputFile& file, const std::string& path,
                                        bool raw_codes);

}  // namespace weft
