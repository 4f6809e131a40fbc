#pragma once
// The size at which surfaces are followed. What a surface is must not depend on the size in which
// its plate is delivered, and a large plate is soft: beyond the bound its pixels cost time and say
// nothing new about where the surface lies.

#include <cstdint>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// The plate's own size up to 960×540 pixels in all, else of about the same shape with as many.
[[nodiscard]] Size follow_size(Size plate);

/// The plate's own size up to `most_px` pixels in all, else of about the same shape with as many.
[[nodiscard]] Size bounded_size(Size plate, std::int64_t most_px);

/// A smaller picture of 8 bit: means over the area of each pixel. `to`: at most the picture's size.
[[nodiscard]] Matte reduced(ViewU8x1 picture, Size to);
[[nodiscard]] ImageU8x3 reduced(ViewU8x3 picture, Size to);

/// Motion in pixels of another size, bilinear between pixel centres; a pixel is valid where the
/// nearest one is.
[[nodiscard]] FlowField resized(const FlowField& motion, Size to);

/// The same motion in pixels of another size, on a lattice of `spacing` px of it.
[[nodiscard]] LatticeField resized(const LatticeField& motion, Size to, int spacing);

}  // namespace weft
