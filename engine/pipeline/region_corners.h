#pragma once
#include <optional>
#include <vector>

#include "engine/motion/corner_track.h"
#include "engine/pipeline/region_motion.h"

namespace weft {

/// A surface's motion as that of a plane.
struct RegionCorners {
    /// On every frame from the first to the last that shows the surface; what lies between and
    /// shows too little of it is interpolated.
    CornerTrack track;
    bool on_form =
        false;  ///< An upright rectangle of the plane that its form is, not of the picture.
    /// How far the surface's places are off the plane's motion, px: over all frames, the median and
    /// the 90th percentile.
    float off_median_px = 0, off_p90_px = 0;
};

/// Four corners, on `reference` a rectangle that surrounds what it shows of the region, or where
/// the form is known and a plane that of plane_corners(), moved by the homographies that fit the
/// surface's motion to `frames` (ascending) best: each straight from the reference frame, so errors
/// do not add up. The form must have been found if the plan has one. Errors: RenderFailed where it
/// moves as no plane does or shows too little; those of RegionMotion.
[[nodiscard]] Expected<RegionCorners> region_corners(const RegionMotion& motion,
                                                     const AnalysisStore& store, int reference,
                                                     const std::vector<int>& frames);

}  // namespace weft
