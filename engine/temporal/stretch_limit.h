#pragma once
#include <optional>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Lets a texture slide back where it is stretched or squeezed more than three times against the
/// reference frame. There the field is pulled, by up to a third per frame, towards the similarity
/// (scale within 2/3 … 3/2) that fits the rest of the surface; otherwise a surface that turns away
/// or tears would smear its texture without limit. Nodes under the limit stay. Returns true if
/// anything changed inside `visible`.
bool limit_stretch(LatticeField& ref_from_cur, ViewU8x1 visible);

/// Frames over which a seam hides that a stretched texture returned to its shape.
inline constexpr int kReanchorFrames = 16;

/// A field without excessive stretch, if a fifth of the surface or more is past that limit. It
/// blends into the given field where that one is not stretched, as smoothly as the limit requires,
/// and is at most the similarity everywhere. Empty if less of the surface is past the limit. Pure.
[[nodiscard]] std::optional<LatticeField> relaxed_stretch(const LatticeField& ref_from_cur,
                                                          ViewU8x1 visible);

/// The similarity (rotation, scale, translation) that fits a field best over `visible`, defined
/// everywhere. Pure.
[[nodiscard]] LatticeField similar_motion(const LatticeField& field, ViewU8x1 visible);

}  // namespace weft
