#pragma once
#include "engine/core/fields.h"

namespace weft {

/// The pieces of a part that are small beside its largest one (less than a quarter of it), 255,
/// else 0; empty if there are none. Arms and legs hang together: what is left behind in between has
/// been taken for them. `part`: H×W, inside from 128 on; pieces are joined at corners, too. Pure.
[[nodiscard]] Matte part_islands(const Matte& part);

}  // namespace weft
