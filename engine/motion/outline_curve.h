#pragma once
// Which places of one outline became which of another.

#include <vector>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// The outer outline of the largest piece of a matte, evenly sampled along its length.
struct OutlineCurve {
    std::vector<Vec2> p;            ///< Frame coordinates, anticlockwise as seen; empty: none.
    std::vector<std::uint8_t> cut;  ///< Not 0 where the frame's border is the outline.
    float step_px = 0;              ///< Between neighbours.
};

/// `extent`: H×W, 8 bit; inside from 128 on. Pure; deterministic.
[[nodiscard]] OutlineCurve outline_curve(ViewU8x1 extent);

/// One place of an outline and where it was.
struct OutlinePair {
    Vec2 cur, prev;
};

/// Pairs of places along the whole outline, in order: of all ways to lay one closed curve along the
/// other the one that keeps corners on corners, bends on bends and lengths (dynamic programming, as
/// Sebastian, Klein & Kimia 2003, "On aligning curves"). `prev_from_cur`: about how the shape moved
/// as a whole; it decides where the curves alike in themselves. Empty if one has no outline, or if
/// much of it is cut off by the frame. Pure; deterministic.
[[nodiscard]] std::vector<OutlinePair> match_outlines(const OutlineCurve& prev,
                                                      const OutlineCurve& cur,
                                                      const LatticeField& prev_from_cur);

/// A slip (outline_slip()) above which a motion slides along the outline: steps of drawn scenes
/// that are right to 1.5 px have 0.027 at most, flags that are off by 4 to 35 px 0.043 to 0.18.
inline constexpr double kSlipping = 0.035;

/// How badly a motion lays one outline along the other: what match_outlines() makes least, by
/// point: corners that come to lie on none, and lengths that change. 0 for a shape that keeps its
/// form. 1 where one has no outline. Pure; deterministic.
[[nodiscard]] double outline_slip(const OutlineCurve& prev, const OutlineCurve& cur,
                                  const LatticeField& prev_from_cur);

}  // namespace weft
