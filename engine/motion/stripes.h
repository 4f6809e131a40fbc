#pragma once
// Surfaces whose picture says how they move across its lines, and nothing of how along them.

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"
#include "engine/motion/photometric_register.h"

namespace weft {

struct Stripes {
    Vec2 along{0, 1};  ///< Their direction, a unit vector.
    /// 0 where the picture has structure in two directions, 1 where it has lines of one alone.
    float share = 0;
};

/// Of the region's slopes of luma as a whole (the structure tensor, Bigün & Granlund 1987): the
/// lines' direction, and by its smaller eigenvalue over the larger one how far there is no other;
/// in full below 0.06, not at all above 0.12. Luma 8 bit, `visible` as a matte, H×W. Pure;
/// deterministic.
[[nodiscard]] Stripes stripes_of(ViewU8x1 luma, ViewU8x1 visible);
/// The same of what registration compares: of the paint, without bands of light and shade.
[[nodiscard]] Stripes stripes_of(const RegistrationPicture& picture);

/// `field` with the motion along the stripes taken from that of the region's outline, as far as
/// `stripes` says: what `outline` has where the edge of `extent` (H×W, the frame's border is none)
/// runs across them, as a plane over the region that leans little where few places say so. `field`
/// itself if there is no such edge. Of one lattice. Pure; deterministic.
[[nodiscard]] LatticeField along_stripes(const LatticeField& field, const LatticeField& outline,
                                         ViewU8x1 extent, const Stripes& stripes);

/// How far a motion departs from `held`, which is along_stripes() of it: the mean over what is
/// `visible`, px. Pure.
[[nodiscard]] float departure(const LatticeField& field, const LatticeField& held,
                              ViewU8x1 visible);

/// `field` with `held`, along_stripes() of it, where the two are further apart than a surface moves
/// beside its outline in a step: not below 4 px of a frame 480 wide, in full from 8 px on. A shade
/// that passes over a corner drags it that far. Pure.
[[nodiscard]] LatticeField held_where_dragged(const LatticeField& field, const LatticeField& held);

/// `field` with the places of `before` along the stripes, as far as `stripes` says, which are those
/// of the picture that the fields lead to. Of one lattice. Pure.
[[nodiscard]] LatticeField changed_across_stripes(LatticeField field, const LatticeField& before,
                                                  const Stripes& stripes);

}  // namespace weft
