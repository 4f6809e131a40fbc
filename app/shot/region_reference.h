#pragma once
// A region's reference frame, and the frame that its light is relative to.

#include <string>
#include <vector>

#include "app/shot/shot.h"

namespace weft {

/// Sets `reference_frames` of the plan, by default the first frame that shows the surface in the
/// shot's light; and `light_frame` where the reference frame is black, burnt out or far darker than
/// the shot. `notes` receives automatic choices that the user should know. `leave_out` as
/// OpenShotOptions has it. Errors: those of choose_reference(); MissingFrames if the plate lacks a
/// frame that the region names.
[[nodiscard]] Expected<ShotReference> add_reference(const Region& region, const CachedReader& plate,
                                                    const MatteLooks& looks,
                                                    const std::vector<int>& leave_out,
                                                    RegionPlan& plan,
                                                    std::vector<std::string>& notes);

}  // namespace weft
