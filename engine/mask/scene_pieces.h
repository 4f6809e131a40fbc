#pragma once
// Internal to resting_scene: pieces of a matte that are large and joined enough to be believed.

#include <cstdint>

#include "engine/core/image.h"

namespace weft {

/// Pieces of fewer pixels go, and what is thinner than three of them.
void keep_large(Matte& pieces, double least_px);

/// What lies beside a piece.
enum class Beside : std::uint8_t { kUnknown, kSurface, kOther };

/// Pieces go unless more of what is known beside them is surface than other, and a share of all, or
/// they have `alone_px` pixels; `beside` has Beside's values. What is thinner than three pixels
/// goes, too.
void keep_joined(Matte& pieces, const Matte& beside, double alone_px);

}  // namespace weft
