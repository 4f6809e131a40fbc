#pragma once
#include <string>

#include "engine/media/frame_writer.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/st_maps.h"

namespace weft {

/// Checks that the shot has ST-maps and the name can hold them. Errors: Usage if a region is not in
/// locked mode, or if the name does not end in .exr.
[[nodiscard]] Status check_st_maps(const std::string& pattern, const ShotPlan& plan);

/// Writes an EXR of 32 bit floats without loss: R, G, B, A of the map `warp` and stabilize.R, .G,
/// .B, .A (docs/FORMATS.md). `write` gives metadata and rule. Errors: as write_exr().
[[nodiscard]] Status write_st_maps(const std::string& path, const StMaps& maps, WriteOptions write);

}  // namespace weft
