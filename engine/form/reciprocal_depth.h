#pragma once
// Whether a depth pass holds distances or their reciprocals.

#include "engine/core/image.h"

namespace weft {

/// True if the plane parts of the picture are straight in `depth` and bent in its reciprocal. Over
/// a picture 1/z of a plane is linear and z is not (perspective), so a pass whose planes are linear
/// holds 1/z, as Nuke's ScanlineRender and depth buffers do. False where nothing tells: no plane
/// lies at a slant. Values that are not positive and finite are background. H×W.
[[nodiscard]] bool looks_reciprocal(ViewF1 depth);

}  // namespace weft
