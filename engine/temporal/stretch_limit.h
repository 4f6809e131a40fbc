#pragma once
#include <optional>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// How much larger (above 1) or smaller the surface as a whole may lie on the reference frame.
struct ScaleRange {
    float least = 1 / 1.1f, most = 1.1f;
};

/// Lets a texture slide back where it is drawn out to more than 2.5 times its width, or to more
/// than 1.6 times its size in either direction beside the whole surface (a texture may grow with
/// that as `range` says). There the field is laid anew: each node's slopes are brought within
/// these limits, and nodes are put where neighbours' slopes agree best (local and global steps
/// after Sorkine & Alexa 2007), 0.7 of the way a frame; otherwise a surface that turns away or
/// tears would smear its texture without limit. What is seen and lies two to four nodes from all
/// that is past a limit stays. Returns true if anything changed.
bool limit_stretch(LatticeField& ref_from_cur, ViewU8x1 visible, ScaleRange range = {});

/// Frames over which a seam hides that a stretched texture returned to its shape.
inline constexpr int kReanchorFrames = 16;

/// A field without excessive stretch, if a fifth of the surface or more is past that limit. It
/// blends into the given field where that one is not stretched, as smoothly as the limit requires,
/// and is at most the similarity everywhere. Empty if less of the surface is past the limit. Pure.
[[nodiscard]] std::optional<LatticeField> relaxed_stretch(const LatticeField& ref_from_cur,
                                                          ViewU8x1 visible, ScaleRange range = {});

/// The similarity (rotation, scale, translation) that fits a field best over `visible`, defined
/// everywhere. Pure.
[[nodiscard]] LatticeField similar_motion(const LatticeField& field, ViewU8x1 visible);

}  // namespace weft
