#pragma once
// What a motion export follows: regions, frames and reference frames.

#include <optional>
#include <string>
#include <vector>

#include "app/motion_export/motion_job.h"

namespace weft {

struct MotionRegion {
    int index = 0;  ///< In ShotPlan::regions.
    std::string name;
    int reference = 0;
};

struct MotionPlan {
    ShotPlan plan;  ///< To be analysed: only these regions and frames, without light and grain.
    std::vector<MotionRegion> regions;  ///< Lowest layer first.
    std::vector<int> frames;            ///< To be written, ascending.

    /// The shot's frame after (+1) or before (−1) one; empty at its ends.
    [[nodiscard]] std::optional<int> neighbour(int frame, int step) const;
    std::vector<int> shot_frames;
};

/// Errors: Usage and MissingFrames, as run_motion_job().
[[nodiscard]] Expected<MotionPlan> plan_motion(const MotionJobSpec& spec, const Shot& shot);

/// Returns true if a frame is black in place of a missing one, so that it shows no surface.
[[nodiscard]] bool shows_black(const Shot& shot, int frame);

}  // namespace weft
