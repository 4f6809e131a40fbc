#pragma once
// Detail for magnification: a texture at twice its resolution.

#include "engine/compute/wrap_mode.h"
#include "engine/core/image.h"

namespace weft {

/// The light that a sensor with texels half as wide would have recorded, as far as the texels tell:
/// `plane`, H×W of four floats in linear light, none below 0 or not finite, at 2H×2W.
///
/// Back-projection (Irani and Peleg 1991): the mean of four texels becomes the texel that they
/// replace, which undoes the blur of the texel's own area. Between the rounds, texels are smoothed
/// along edges and lines, by the direction and coherence of the structure tensor, so that a line
/// keeps one width and one tone instead of a bead at every texel that it crosses. No texel leaves
/// the range of the 3×3 around it: there are no rings. Deterministic; by tiles over parallel_for().
[[nodiscard]] Image<float, 4> finer_level(const Image<float, 4>& plane, WrapMode wrap);

}  // namespace weft
