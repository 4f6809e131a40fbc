#pragma once
// Internal to matte_propagation: a boundary that is corrected in places.

#include "engine/core/image.h"

namespace weft {

/// 255 where `inside` (0 outside) and the sign of `distance` differ; both of one size.
[[nodiscard]] Matte differing(const Matte& inside, const ImageF1& distance);

/// Takes over what `inside` (0 outside) has otherwise than `distance`, a signed distance up to
/// `limit_px`, and the matte of it. What is as it was keeps its edge to a fraction of a pixel.
void take_over(const Matte& inside, float limit_px, ImageF1& distance, Matte& matte);

/// Adds to a matte what is 255 in `pieces`, a smaller picture of its shape.
void add_pieces(const Matte& pieces, Matte& matte);

/// 255 where `distance` is inside and `pieces` is 0; both of one size.
[[nodiscard]] Matte inside_without(ViewF1 distance, const Matte& pieces);
/// 255 where `distance` is inside or `pieces` is not 0; both of one size.
[[nodiscard]] Matte inside_with(ViewF1 distance, const Matte& pieces);

}  // namespace weft
