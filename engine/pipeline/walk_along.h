#pragma once
// Internal to follow_surfaces(): the steps of a region's walk, or what an earlier walk found that
// came the same way.

#include "engine/motion/lattice_field.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/surface_job.h"
#include "engine/pipeline/surface_stop.h"

namespace weft {

/// Begins at a reference. `base`: where it was on the primary one; null: it is that.
void begin_walk(SurfaceJob& job, const PlateViews& views, const SurfaceStop& stop,
                FlowQuality quality, const LatticeField* base);
/// Goes on by an estimated step. `hide`: see SurfaceWalker::hide_reanchoring().
void walk_on(SurfaceJob& job, const SurfaceStop& stop, bool hide, const ShotPlan& plan);
/// The drawing of the frame before is held.
void hold_walk(SurfaceJob& job);
/// Makes the frame an anchor, with the surface at `placed` on the reference, or where it was found.
void anchor_walk(SurfaceJob& job, const LatticeField* placed);

}  // namespace weft
