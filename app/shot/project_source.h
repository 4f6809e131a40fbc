#pragma once
#include <memory>
#include <vector>

#include "app/project/project.h"
#include "app/shot/input_watch.h"
#include "app/shot/painted_mattes.h"
#include "app/shot/scene_cuts.h"
#include "engine/media/frame_cache.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// Reads the images of a project. `regions`: planned regions in the plan's order. `cuts` receives
/// every plate frame that is read; `inputs` is told of every file before it is read. Painted
/// keyframes in `painted` are not read from files.
[[nodiscard]] std::shared_ptr<const ShotSource> make_project_source(
    std::shared_ptr<const CachedReader> plate, std::vector<Leaf<Region>> regions,
    std::shared_ptr<CutWatch> cuts = nullptr, std::shared_ptr<InputWatch> inputs = nullptr,
    PaintedMattes painted = {});

}  // namespace weft
