#pragma once
#include "engine/core/fields.h"
#include "engine/core/geometry.h"

namespace weft {

/// The smallest rectangle that holds every pixel of a matte of at least `least` (0 to 255); empty
/// when there is none. Thread-safe.
[[nodiscard]] Recti matte_box(ViewU8x1 matte, std::uint8_t least = 128);

}  // namespace weft
