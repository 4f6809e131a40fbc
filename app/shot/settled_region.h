#pragma once
#include "app/shot/shot.h"

namespace weft {

/// Decides once, for all frames, what a region leaves open: the Cryptomatte's files, the mattes'
/// channels, the passes' layers; and leaves out what lies beyond the plate's frames. `shot` has its
/// plate, and gets notes and warnings. Errors: those of what is decided.
[[nodiscard]] Status settle_region(Region& region, Shot& shot);

}  // namespace weft
