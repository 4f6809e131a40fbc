#pragma once
// The mesh of a motion export.

#include "app/motion_export/motion_frames.h"
#include "app/motion_export/motion_manifest.h"

namespace weft {

/// Writes a region's mesh for each program. Held frames are as the frames that they repeat. Errors:
/// those of region_mesh() and of the disk.
[[nodiscard]] Expected<MeshSummary> write_motion_mesh(const MotionFramesInputs& in,
                                                      const AnalysisStore& store, double fps);

}  // namespace weft
