#pragma once
#include <map>
#include <vector>

#include "engine/form/surface_mesh.h"
#include "engine/pipeline/region_motion.h"

namespace weft {

/// A region's surface as a mesh: squares over what `reference` shows of it (an eightieth of the
/// longer side of its box, 4 px at least), whose corners lie on `frames` where its motion takes
/// them. Where its form is known with its depth, z is that: f · (1 − depth / mean depth on the
/// reference frame), f the focal length in pixels, so that at the mean depth a unit is as wide as
/// it is deep. The form must have been found if the plan has one. Errors: those of RegionMotion;
/// RenderFailed where the reference frame shows nothing.
[[nodiscard]] Expected<SurfaceMesh> region_mesh(const RegionMotion& motion,
                                                const AnalysisStore& store, int reference,
                                                const std::vector<int>& frames);

}  // namespace weft
