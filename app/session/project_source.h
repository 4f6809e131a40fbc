#pragma once
#include <memory>
#include <vector>

#include "app/project/project.h"
#include "app/session/scene_cuts.h"
#include "engine/media/frame_cache.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// The pictures of a project from its files. `regions`: the planned ones, in the plan's order.
/// `cuts` sees every plate that is read.
[[nodiscard]] std::shared_ptr<const ShotSource> make_project_source(
    std::shared_ptr<const CachedReader> plate, std::vector<Leaf<Region>> regions,
    std::shared_ptr<CutWatch> cuts = nullptr);

}  // namespace weft
