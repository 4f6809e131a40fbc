#pragma once
#include "engine/compute/backend.h"

namespace weft {

/// Backend::sample_plane() on the CPU, by bands of rows over parallel_rows(). The pixel's square is
/// cut into nx × ny equal cells; each cell's centre goes through the Jacobian onto the plane and is
/// looked up with a cubic on the level whose texels match the cells (elliptical footprints by
/// regular supersampling; a box over the pixel's area is what a renderer's ideal camera
/// integrates).
void sample_plane_cpu(const SampleRequest& request, ImageView<float, 3> out);

}  // namespace weft
