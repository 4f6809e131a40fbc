#pragma once
#include "engine/core/alpha.h"
#include "engine/core/image.h"

namespace weft {

/// Makes a picture that is transparent in places one that can be a texture plane: straight colours,
/// and where less than half of a pixel is there, a smooth continuation of what is around it. All
/// H×W; an empty `alpha`, or one of nothing but 0, changes nothing. Values must be finite.
/// Thread-safe.
void make_opaque(ImageF3& rgb, const ImageF1& alpha, AlphaKind kind);

}  // namespace weft
