#pragma once
// How far a plane's texture strays from one lattice: whether stripes and courses jump sideways.

#include "engine/synthesis/texture_plane.h"

namespace weft {

/// Distances from the lattice that fits the whole plane best, in pixels.
struct PlanePhase {
    double median_px = 0, p95_px = 0, worst_px = 0;
    double share = 0;  ///< Of the places that could be measured.
};

/// Of every texel: the phase of the sample's pixel that it shows. Exact; the sample's own
/// irregularity is left out. `plane_lattice` is the sample's, on the torus of the plane if it is
/// one.
[[nodiscard]] PlanePhase source_phase(ImageView<const std::int32_t, 2> source,
                                      const SampleLattice& sample,
                                      const PlaneLattice& plane_lattice);

/// As seen, every 8 px: the phases of the two strongest waves of the lattice in windows of one and
/// a half periods. Places where one of them is weak are left out.
[[nodiscard]] PlanePhase seen_phase(ViewU8x3 plane, const PlaneLattice& plane_lattice);

}  // namespace weft
