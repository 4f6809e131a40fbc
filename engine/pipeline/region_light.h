#pragma once
#include <optional>

#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// The light on a region on a frame: estimated, from the artist's pass, or painted; nothing where it
/// comes from a picture or from nowhere. `working`: the plate in the working space. Errors: those of
/// the source and of the store.
[[nodiscard]] Expected<std::optional<Shading>> region_shading(const ShotSource& source,
                                                              const RegionPlan& region,
                                                              const AnalysisStore& store, int index,
                                                              int frame, const ImageF3& working);

}  // namespace weft
