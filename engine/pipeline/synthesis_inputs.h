#pragma once
#include <cstdint>

#include "engine/pipeline/region_plan.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// The region's samples as synthesis sees them, in 8 bit.
[[nodiscard]] std::vector<ImageU8x3> synthesis_samples(const RegionPlan& region);

/// A region's settings for growing a plane of `size`. Frame, guide and tiling are set by the
/// caller. The backend may search for placements; the plane is the same without it.
[[nodiscard]] PlaneOptions plane_options(const RegionPlan& region, std::uint64_t seed, Size size,
                                         const Backend* backend = nullptr);

/// grow_plane() of the region's samples.
[[nodiscard]] Expected<TexturePlane> grow_texture(const RegionPlan& region,
                                                  const PlaneOptions& options,
                                                  const CancelToken& cancel = {},
                                                  const ProgressFn& progress = {});

}  // namespace weft
