#pragma once
// What scribbles change of a matte that is painted already.

#include "engine/core/image.h"

namespace weft {

/// As segment_scribbles(), but where something is painted in `base`, lines inside only add to it
/// and lines outside only take away, and only what hangs together with a line: whatever else the
/// cut finds is left as it was painted. Lines outside act on their own, too, within their reach.
[[nodiscard]] Matte change_by_scribbles(const Matte& base, ViewU8x3 picture, const Matte& keep,
                                        const Matte& drop);

/// Whether lines could change it: on an empty matte those outside alone say nothing.
[[nodiscard]] bool is_empty(const Matte& matte);

}  // namespace weft
