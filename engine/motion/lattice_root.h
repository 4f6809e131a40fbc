#pragma once
#include "engine/motion/lattice_field.h"

namespace weft {

/// A place that a field takes to a target, and by how much it misses it, px.
struct LatticeRoot {
    Vec2 place;
    float miss;
};

/// The place near `start` that `field` takes to `target`, by Newton's method; never further from it
/// than `start` is. Thread-safe.
[[nodiscard]] LatticeRoot root_of(const LatticeField& field, Vec2 target, Vec2 start);

/// About inverse(field), on nodes that are no closer than 16 px, which takes far less time where
/// the field's are: where to start root_of() from.
[[nodiscard]] LatticeField coarse_inverse(const LatticeField& field);

/// there_from_here of a surface whose ref_from_here and ref_from_there are known: each node goes to
/// the place of `there` that shows the same place of the reference frame. Unlike
/// compose(ref_from_here, inverse(ref_from_there)) it needs nothing of the reference frame beyond
/// its border, where a surface lies that came into view later. Where `there` folds over it gives a
/// place nearby. Both of the same frame size; the result has the finer
/// spacing.
[[nodiscard]] LatticeField through_reference(const LatticeField& ref_from_here,
                                             const LatticeField& ref_from_there);

}  // namespace weft
