#pragma once
#include <optional>

#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// The shading of a region on a frame: estimated, from the artist's pass, or painted. Empty if the
/// light comes from a picture or there is none. `working`: the plate in the working space. Errors:
/// those of the source and of the store.
[[nodiscard]] Expected<std::optional<Shading>> region_shading(const ShotSource& source,
                                                              const RegionPlan& region,
                                                              const AnalysisStore& store, int index,
                                                              int frame, const ImageF3& working);

}  // namespace weft
