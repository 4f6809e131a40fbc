#pragma once
// A region's matte as shapes of Bezier curves over time.

#include <vector>

#include "engine/mask/outline_lives.h"
#include "engine/pipeline/region_motion.h"

namespace weft {

/// A frame to draw the matte of.
struct ShapedFrame {
    int frame = 0;
    int shown = 0;       ///< The one that it shows, another one where it is held.
    bool empty = false;  ///< Shows nothing, so every shape ends before it.
};

struct RegionShapes {
    std::vector<MatteShape> shapes;  ///< By level, then by first frame; keys by frame.
    /// How far the matte's outlines at half coverage are from the shapes, px: over all frames, the
    /// mean, and the mean of the worst frame.
    float off_mean_px = 0, off_worst_px = 0;
};

/// What `frames` (ascending) show of a region, holdouts taken off, as shapes that begin on
/// `reference`, as matte_shapes() does. Outlines around less than 12 px² are left out unless they
/// are all that there is. Errors: those of RegionMotion; RenderFailed where no frame shows it.
[[nodiscard]] Expected<RegionShapes> region_shapes(const RegionMotion& motion,
                                                   const ShapedFrame& reference,
                                                   const std::vector<ShapedFrame>& frames);

}  // namespace weft
