#pragma once
#include <cstdint>

#include "engine/core/image.h"
#include "engine/core/pixel_aspect.h"
#include "engine/form/view_camera.h"

namespace weft {

/// What a depth pass holds.
enum class DepthKind : std::uint8_t {
    kZ,   ///< The distance along the camera's axis (Cycles, Nuke, V-Ray, OpenEXR's Z).
    kRay  ///< The distance from the camera (Arnold's Z is this one in some versions).
};

/// The places in view space that a depth pass shows, H×W×3 in its unit of length. `camera`: of the
/// picture unsqueezed; `aspect`: of the pass's pixels. Values that are
/// not above 0, or 1e10 and more (renderers' background), are not finite in the result.
/// Thread-safe.
[[nodiscard]] ImageF3 positions_from_depth(const ImageF1& depth, DepthKind kind,
                                           const ViewCamera& camera, PixelAspect aspect = {});

}  // namespace weft
