#pragma once
// A round surface from its outline.

#include "engine/core/image.h"
#include "engine/form/metric_field.h"
#include "engine/form/view_camera.h"

namespace weft {

/// Adds the metric of the surface that bulges towards the camera inside of a matte's outline. Where
/// the outline turns away, the surface meets the picture plane at right angles: its height is
/// roundness · √(u / k) with ∇²u = −4 inside and u = 0 on the outline, since squares of heights
/// are smooth there (Prasad & Fitzgibbon 2006; Johnston 2002 does the same with normals). k, from 1
/// to 2, is the larger curvature of −u by half, so that a disc becomes a ball and a strip a round
/// tube. Where `cut` (of the matte's size) is 255, and at the picture's borders, the outline is
/// free: ∂u/∂n = 0. Only places of `seen` count, the more the more squarely they are seen. Returns
/// false if the matte turns away nowhere or is smaller than a few pixels. Deterministic everywhere;
/// thread-safe.
bool add_inflated(MetricField& field, ViewU8x1 matte, ViewU8x1 cut, ViewU8x1 seen,
                  const ViewCamera& camera, double roundness);

}  // namespace weft
