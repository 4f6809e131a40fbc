#pragma once
// Texture synthesis by PatchMatch (Barnes et al. 2009), to compare with: each frame by itself.

#include <cstdint>

#include "engine/core/image.h"

namespace weft {

struct PatchMatchOptions {
    Size size{256, 256};  ///< Of the picture, texels.
    std::uint64_t seed = 1;
    std::uint64_t region = 0, frame = 0;  ///< Further keys of the random numbers.
    int search_rounds = 3;                ///< Propagation and random search for each vote.
};

/// A picture of the sample's texture, from coarse to fine: at each level patches of 7×7 look for
/// their nearest neighbours in the sample by propagation and random search (Barnes et al. 2009,
/// section 3), then vote for the pixels they cover, the better the match the more (Wexler et al.
/// 2007, eq. 5). The finest level ends with a copy: each pixel is taken from the best patch that
/// covers it, so that nothing blurs. A sample of less than 8×8 is repeated as it is. One thread;
/// deterministic.
[[nodiscard]] ImageU8x3 patch_match_texture(ViewU8x3 sample, const PatchMatchOptions& options);

}  // namespace weft
