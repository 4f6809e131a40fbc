#pragma once
#include <optional>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Lets a texture slide back where it has been drawn out or squeezed more than three times against
/// the reference frame: there the field is pulled, by up to a third a frame, towards the similarity
/// (scale within 2/3 … 3/2) that fits the rest of the surface. A surface that turns away or tears
/// would otherwise smear its texture without limit. Nodes under the limit stay as they are. Returns
/// whether anything changed inside `visible`.
bool limit_stretch(LatticeField& ref_from_cur, ViewU8x1 visible);

/// How many frames a seam has to hide that a texture was let go back to its shape.
inline constexpr int kReanchorFrames = 16;

/// Where a fifth of the surface or more is past that limit: a field without it, which goes over
/// into the given one where that is not stretched as smoothly as the limit wants, at the most the
/// similarity everywhere. Nothing where less is. Pure.
[[nodiscard]] std::optional<LatticeField> relaxed_stretch(const LatticeField& ref_from_cur,
                                                          ViewU8x1 visible);

/// The similarity (rotation, scale, translation) that fits a field best over `visible`, everywhere.
/// Pure.
[[nodiscard]] LatticeField similar_motion(const LatticeField& field, ViewU8x1 visible);

}  // namespace weft
