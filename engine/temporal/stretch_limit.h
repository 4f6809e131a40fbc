#pragma once
#include <optional>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// How much larger (above 1) or smaller the surface as a whole may lie on the reference frame.
struct ScaleRange {
    float least = 1 / 1.1f, most = 1.1f;
};

/// How much longer than wide a round spot of the texture may become, and how many times larger or
/// smaller beside the whole surface; and what it is brought back to where it is past that, so that
/// it is not at once again. A ball shows the first limit where it is turned away by 73°.
struct StretchLimits {
    float drawn_out = 3.5f, scaled = 2.0f;
    float drawn_out_after = 1.5f, scaled_after = 1.2f;
    ScaleRange whole = {};

    /// Between these and `tight`, which `share` is 1 of.
    [[nodiscard]] StretchLimits towards(const StretchLimits& tight, float share) const;
};

/// Lets a texture slide back where it is past the limits. There the field is laid anew: slopes past
/// a limit become slopes well within it, and nodes are put where the slopes of neighbours agree
/// best (local and global steps after Sorkine & Alexa 2007), 0.7 of the way a frame; otherwise a
/// surface that turns away or tears would smear its texture without limit. What is seen and further
/// than four nodes from all that is past a limit stays. Returns true if anything changed.
bool limit_stretch(LatticeField& ref_from_cur, ViewU8x1 visible, const StretchLimits& limits = {});

/// Frames over which a seam hides that a stretched texture returned to its shape, at most.
inline constexpr int kReanchorFrames = 16;

/// A field without excessive stretch, if a fifth of the surface or more is past the limits. It
/// blends into the given field where that one is not stretched, as smoothly as the limit requires,
/// and is at most the similarity everywhere, as it is out of sight. Empty if less of the surface is
/// past the limit. Pure.
[[nodiscard]] std::optional<LatticeField> relaxed_stretch(const LatticeField& ref_from_cur,
                                                          ViewU8x1 visible,
                                                          const StretchLimits& limits = {});

/// The similarity (rotation, scale of 2/3 to 3/2, translation) that fits a field best over
/// `visible`, defined everywhere. Pure.
[[nodiscard]] LatticeField similar_motion(const LatticeField& field, ViewU8x1 visible);

/// The field as it is where it is seen or nearly so; where it is past the limits above farther off,
/// as that similarity everywhere out of sight. A homography is past them beyond its horizon, and a
/// smooth field that goes on from it would be drawn along. Pure.
[[nodiscard]] LatticeField tame_out_of_sight(const LatticeField& field, ViewU8x1 visible);

}  // namespace weft
