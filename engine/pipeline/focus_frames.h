#pragma once
#include <vector>

#include "engine/pipeline/region_plan.h"

namespace weft {

/// The frames of RegionPlan::focus_frames on which a region's focus is read first: every
/// kFocusStep-th one, by its number, and the ends of runs of frames. It does not depend on the
/// frames to be rendered.
[[nodiscard]] std::vector<int> focus_grid(const RegionPlan& region);
/// Those of them that tell the focus of a frame to be rendered; empty if the region has none.
[[nodiscard]] std::vector<int> needed_focus_frames(const ShotPlan& plan, const RegionPlan& region);
/// The frames of RegionPlan::focus_frames between two neighbours of the grid.
[[nodiscard]] std::vector<int> focus_frames_between(const RegionPlan& region, int before,
                                                    int after);
/// Whether what is read on a frame has to be propagated to it.
[[nodiscard]] bool focus_needs_propagation(const RegionPlan& region);

}  // namespace weft
