#pragma once
// A camera that stands still, as an explanation of motion.

#include <vector>

#include "engine/core/geometry.h"
#include "engine/form/rigid_fit.h"

namespace weft {

constexpr double kTrackError = 0.2 / 854;  ///< Of a track that fits well, by the long side.

/// How far matches are from what a camera at one place shows, which turns and zooms: the residual
/// of each frame over what tracks and lenses are known to be off by (0.2 px at 854 px and 1 % of
/// how far the picture moves), root mean square over the frames, under the field of view that
/// explains the most. Such a camera shows every surface alike, whatever its form (a rotation's
/// homography, Hartley & Zisserman 2004, 8.4.2): near 1 there is no parallax. Infinite if the
/// matches are too few. Bit-identical everywhere; thread-safe.
[[nodiscard]] double beyond_still_camera(const std::vector<FrameMatches>& frames, Size picture);

/// Whether matches show more than such a camera would. Thread-safe.
[[nodiscard]] bool shows_parallax(const std::vector<FrameMatches>& frames, Size picture);

}  // namespace weft
