#pragma once
// The roto shapes of a motion export.

#include "app/motion_export/motion_frames.h"
#include "engine/pipeline/region_shapes.h"

namespace weft {

/// Writes a region's shapes for each program and returns them. Errors: those of region_shapes() and
/// of the disk.
[[nodiscard]] Expected<RegionShapes> write_motion_shapes(const MotionFramesInputs& in);

}  // namespace weft
