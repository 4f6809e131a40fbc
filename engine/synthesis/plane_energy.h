#pragma once
// The energy of a plane's seams, recounted from its source map.

#include <cstdint>

#include "engine/core/image.h"
#include "engine/synthesis/sample_atlas.h"

namespace weft {

struct PlaneEnergy {
    double energy = 0;
    std::int64_t length_px = 0;
};

/// The part of recount_energy() between texel `p` and its right and lower neighbours.
[[nodiscard]] PlaneEnergy texel_energy(const SampleAtlas& atlas,
                                       ImageView<const std::int32_t, 2> source, Vec2i p, bool wrap);

/// Sums ‖A−B‖(p) + ‖A−B‖(q) over all neighbouring texels p, q whose source pixels are not the same
/// neighbours in the sample, where A is the texture continued from p's source and B from q's, ‖·‖
/// the Euclidean norm of RGB in 8-bit units. A continuation that lies outside of the sample takes
/// the sample's nearest border pixel. With `wrap` the opposite borders are neighbours too. Sources
/// are positions in the atlas. Pure; the same for any number of threads.
[[nodiscard]] PlaneEnergy recount_energy(const SampleAtlas& atlas,
                                         ImageView<const std::int32_t, 2> source, bool wrap);

}  // namespace weft
