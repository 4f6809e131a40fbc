#pragma once
// What a sample's repetition means for the plane that is grown from it.

#include "engine/synthesis/plane_lattice.h"
#include "engine/synthesis/texture_period.h"

namespace weft {

struct PlaneStructure {
    PlaneLattice lattice;  ///< All patches lie on it; empty: none.
    TexturePeriod period;  ///< Without a lattice patches keep it to their neighbours.
};

}  // namespace weft
