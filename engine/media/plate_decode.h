#pragma once
// Internal: converts a file's samples into a plate.

#include "engine/core/error.h"
#include "engine/media/frame_reader.h"
#include "engine/media/raster.h"

namespace weft {

[[nodiscard]] PixelDepth depth_of(SampleKind kind);
/// Integer files hold display-encoded values, the others scene-linear ones.
[[nodiscard]] bool is_display_encoded(SampleKind kind);

/// Grey is copied into all three channels; a second or fourth channel is the alpha.
[[nodiscard]] PlateFrame to_plate(const Raster& raster);

}  // namespace weft
