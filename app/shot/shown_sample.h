#pragma once
// A sample that is shown itself instead of being synthesized from.

#include "engine/pipeline/region_plan.h"

namespace weft {

/// Makes the sample a picture of its own by the plan's mode, one of shows_sample(): whole periods
/// of it tiled, all of it mirrored, or, once, stretched over the placement's corners; without
/// corners it covers the plate.
void show_sample(Size plate, const ColorTransform& display_from_texture, TexturePicture& texture,
                 RegionPlan& plan);

}  // namespace weft
