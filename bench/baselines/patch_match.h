#pragma once
// Texture synthesis by PatchMatch (Barnes et al. 2009), a baseline: each frame by itself.

#include <cstdint>

#include "engine/core/image.h"

namespace weft {

struct PatchMatchOptions {
    Size size{256, 256};  ///< Of the picture, texels.
    std::uint64_t seed = 1;
    std::uint64_t region = 0, frame = 0;  ///< Further keys of the random numbers.
    int search_rounds = 3;                ///< Propagation and random search for each vote.
};

/// A picture of the sample's texture, from coarse to fine. At each level patches of 7×7 find their
/// nearest neighbours in the sample by propagation and random search (Barnes et al. 2009, section
/// 3), then vote for the pixels they cover, weighted by the match (Wexler et al. 2007, eq. 5). The
/// finest level ends with a copy: each pixel comes from the best patch that covers it, so that
/// nothing is blurred. A sample smaller than 8×8 is repeated. One thread; deterministic.
[[nodiscard]] ImageU8x3 patch_match_texture(ViewU8x3 sample, const PatchMatchOptions& options);

}  // namespace weft
