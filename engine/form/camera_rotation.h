#pragma once
#include <array>
#include <optional>

#include "engine/core/image.h"
#include "engine/form/view_camera.h"

namespace weft {

/// How the camera of a rendered frame is turned, from the places that its pixels show: the rotation
/// from the places' axes into the camera's (x to the right, y up, z towards the viewer), by rows.
/// Linear resection (Hartley & Zisserman 2004, ch. 7); of places on one plane by its homography
/// (ibid., ch. 8). `places`: H×W×3 at pixels' centres; what is not finite does not count. Empty if
/// fewer than 24 places are known, if they lie on a line, and if the camera would show them more
/// than `most_px` from where they are in the median. Thread-safe.
[[nodiscard]] std::optional<std::array<double, 9>> camera_rotation(ViewF3 places,
                                                                   const ViewCamera& camera,
                                                                   double most_px = 2);

}  // namespace weft
