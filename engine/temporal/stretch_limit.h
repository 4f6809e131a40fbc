#pragma once
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Lets a texture slide back where it has been drawn out or squeezed more than three times against
/// the reference frame: there the field is pulled, by up to a third a frame, towards the similarity
/// (scale within 2/3 … 3/2) that fits the rest of the surface. A surface that turns away or tears
/// would otherwise smear its texture without limit. Nodes under the limit stay as they are. Returns
/// whether anything changed inside `visible`.
bool limit_stretch(LatticeField& ref_from_cur, ViewU8x1 visible);

/// The similarity (rotation, scale, translation) that fits a field best over `visible`, everywhere.
/// Pure.
[[nodiscard]] LatticeField similar_motion(const LatticeField& field, ViewU8x1 visible);

}  // namespace weft
