#pragma once
// Internal: alphas that are none.

#include "engine/media/raster.h"

namespace weft {

/// The fourth byte of a 32-bit BMP is reserved, and many programs write TGAs of 32 bits without an
/// alpha: nothing but 0, under a picture that is meant to be seen. Such an alpha is taken out.
void drop_unmade_alpha(Raster& raster);

}  // namespace weft
