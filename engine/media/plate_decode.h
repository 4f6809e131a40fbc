#pragma once
// Internal: samples as they stand in a file → a plate.

#include "engine/core/error.h"
#include "engine/media/frame_reader.h"
#include "engine/media/raster.h"

namespace weft {

[[nodiscard]] PixelDepth depth_of(SampleKind kind);
/// Integer files hold values for a display, the others scene-linear ones.
[[nodiscard]] bool is_display_encoded(SampleKind kind);

/// Grey goes into all three channels; a second or fourth channel is the alpha.
[[nodiscard]] PlateFrame to_plate(const Raster& raster);

}  // namespace weft
