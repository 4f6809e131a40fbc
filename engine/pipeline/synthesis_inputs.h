#pragma once
#include <cstdint>

#include "engine/pipeline/region_plan.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// The region's samples in 8 bit as synthesis sees them.
[[nodiscard]] std::vector<ImageU8x3> synthesis_samples(const RegionPlan& region);

/// A region's settings for growing a plane of `size`; frame, guide and tiling are the caller's. The
/// backend may search for placements; the plane is the same without.
[[nodiscard]] PlaneOptions plane_options(const RegionPlan& region, std::uint64_t seed, Size size,
                                         const Backend* backend = nullptr);

/// grow_plane() of the region's samples.
[[nodiscard]] Expected<TexturePlane> grow_texture(const RegionPlan& region,
                                                  const PlaneOptions& options,
                                                  const CancelToken& cancel = {},
                                                  const ProgressFn& progress = {});

}  // namespace weft
