#pragma once
// Looks for a surface around the place where it is expected.

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"
#include "engine/motion/optical_flow.h"
#include "engine/motion/surface_flow.h"

namespace weft {

/// What may have been missed.
enum class MissedBy {
    kSurface,  ///< All of it, more or less: a smooth field as fit_surface_motion() finds it.
    kParts,    ///< Some parts alone, such as a fold; to that fit they would be outliers.
};

struct WideSearch {
    LatticeField anchor_from_cur;  ///< To be registered; on the lattice of `expected`.
    double known_share = 0;  ///< Of what both show, the pixels whose way there and back agrees.
};

/// The motion between two frames that may lie far apart in time. `expected`: anchor_from_cur, wrong
/// by several pixels in places, beyond what registration reaches. The anchor's picture is moved to
/// where it is expected, dense inverse search (estimate_surface_flow()) finds by how much each
/// place misses, and a field is fitted to that. `luma`: what cur's picture was made from,
/// H×W. Pure; deterministic.
[[nodiscard]] WideSearch search_around(const SurfaceView& anchor, const SurfaceView& cur,
                                       ViewU8x1 luma, const LatticeField& expected, MissedBy missed,
                                       FlowQuality quality);

}  // namespace weft
