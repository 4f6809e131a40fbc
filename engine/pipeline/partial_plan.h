#pragma once
// Plans of which only a part is analysed.

#include "engine/pipeline/region_plan.h"

namespace weft {

/// Leaves out what the camera adds: grain, focus and shutter.
void leave_camera_out(RegionPlan& region);
/// Leaves zones, light, grain and shutter out: what does not move the texture.
void leave_look_out(RegionPlan& region);
/// Leaves nothing of the region to be followed or propagated.
void leave_region_out(RegionPlan& region);

}  // namespace weft
