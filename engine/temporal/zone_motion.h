#pragma once
// The motion of a surface changed inside of a painted zone, and nowhere else.

#include <vector>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// A zone on a frame, and how far it acts there.
struct MotionZone {
    ViewU8x1 matte;    ///< H×W coverage of the zone.
    ViewU8x1 surface;  ///< The same of the whole surface, hidden parts included.
    float amount = 1;  ///< 0: nothing changes, 1: in full.
};

// All of these take and return ref_from_cur, px. Inside of the zone the field becomes another one,
// solved for with a fixed boundary: the nodes further than one spacing outside of it keep their
// values, so that no pixel changes that lies further than three spacings (24 px of a plate up to
// 960×540, 2.5 % of the width of a larger one) outside. Where the zone reaches the surface's edge,
// nothing holds it there. Pure; deterministic. Mattes have the frame's size.

/// As if the picture said nothing inside: the plane that the surface around the zone moves by, and
/// what departs from it along the boundary, continued inside as a membrane. A zone that covers the
/// whole surface moves as a plane.
[[nodiscard]] LatticeField without_picture(const LatticeField& ref_from_cur,
                                           const MotionZone& zone);

/// What is inside moves as one plane: straight lines stay straight.
[[nodiscard]] LatticeField stiffened(const LatticeField& ref_from_cur, const MotionZone& zone);

/// What departs from the motion of one plane inside is averaged over time, on the surface: over
/// `others`, ref_from_cur of the frames around this one, each with its distance in frames; a
/// Gaussian of kCalm_frames / 2. Surfaces that deform evenly keep their motion.
struct OtherFrame {
    LatticeField ref_from_cur;
    int distance = 0;
};
inline constexpr int kCalm_frames = 8;
[[nodiscard]] LatticeField calmed(const LatticeField& ref_from_cur, const MotionZone& zone,
                                  const std::vector<OtherFrame>& others);

/// What is inside moves as the plane that `around`, the motion of its surroundings in the picture,
/// follows: `seen` is where that was measured.
[[nodiscard]] LatticeField with_surroundings(const LatticeField& ref_from_cur,
                                             const MotionZone& zone, const LatticeField& around,
                                             ViewU8x1 seen);

}  // namespace weft
