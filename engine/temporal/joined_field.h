#pragma once
// One field from those of a surface's parts.

#include <cstdint>
#include <vector>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// No part's pixel.
constexpr std::uint8_t kNobody = 255;

/// At every node the field of the part that owns the pixel there, or else the nearest one that is
/// owned. `fields`: one or more, of one frame size. `owner`: H×W, index of a field or kNobody.
/// Between parts the result is steep over one `spacing_px`. Pure; deterministic.
[[nodiscard]] LatticeField joined_field(const std::vector<LatticeField>& fields,
                                        const Image<std::uint8_t, 1>& owner, int spacing_px);

}  // namespace weft
