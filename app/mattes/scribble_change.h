#pragma once
// What scribbles change of a matte that is painted already.

#include "engine/core/image.h"

namespace weft {

/// What lines find where nothing else is painted: as segment_scribbles(), but if those inside alone
/// end at edges of the picture, those outside only take away from that what hangs together with
/// them. `before`: what scribbles have found so far.
[[nodiscard]] Matte found_by_scribbles(const Matte& before, ViewU8x3 picture, const Matte& keep,
                                       const Matte& drop);

/// On what is painted already, lines inside only add and lines outside only take away, and only
/// what hangs together with a line: whatever else the cut finds is left as it was painted. Lines
/// outside act on their own, too, within their reach.
[[nodiscard]] Matte change_by_scribbles(const Matte& base, ViewU8x3 picture, const Matte& keep,
                                        const Matte& drop);

/// Whether lines could change it: on an empty matte those outside alone say nothing.
[[nodiscard]] bool is_empty(const Matte& matte);

}  // namespace weft
