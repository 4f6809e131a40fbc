#pragma once
// A sample that is shown itself instead of being synthesized from.

#include "engine/pipeline/region_plan.h"

namespace weft {

/// Makes the sample a picture of its own by the plan's mode, one of shows_sample(): whole periods
/// of it tiled, all of it mirrored, or, once, stretched over the placement's corners; without
/// corners over `box`, in pixels of the reference frame.
void show_sample(const Recti& box, const ColorTransform& display_from_texture,
                 TexturePicture& texture, RegionPlan& plan);

}  // namespace weft
