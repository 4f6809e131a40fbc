#pragma once
// Internal: PNG through libpng itself, because ids of a palette matte are indices, which
// OpenImageIO turns into colours, and because libpng's messages must reach the caller, not stderr.

#include <string>

#include "engine/media/raster.h"

namespace weft {

/// True when the file begins with the PNG signature.
[[nodiscard]] bool is_png(const std::string& path);
[[nodiscard]] Expected<RasterInfo> probe_png(const std::string& path);
[[nodiscard]] Expected<Raster> read_png(const std::string& path, bool raw_codes);

}  // namespace weft
