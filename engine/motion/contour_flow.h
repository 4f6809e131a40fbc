#pragma once
// Motion of a surface that shows little more than its outline: flat fills, drawn or plain.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// The structure inside a region over what the motion leaves unexplained: the median slope of the
/// luma over the median of |cur − prev(p + prev_from_cur)|, both in levels after a Gaussian of 1 px
/// and against half a level of quantisation. Photographs and textured renderings have 2 to 20; at
/// about 1 there is only noise. Luma 8 bit; `visible` as in SurfaceWalker; all H×W. Infinity if too
/// few pixels can be compared. Pure.
[[nodiscard]] float structure_to_noise(ViewU8x1 cur, ViewU8x1 cur_visible, ViewU8x1 prev,
                                       ViewU8x1 prev_visible, const FlowField& prev_from_cur);

/// prev_from_cur of a region (pixels) from its outline and from what is drawn inside. Both frames
/// are replaced by the signed distance to the outline, clipped to a band, plus the luma inside, so
/// that nothing outside the region has an effect; then DIS runs with wide patches. Valid inside
/// `cur_visible`. All H×W, as above. Deterministic; pure.
[[nodiscard]] FlowField estimate_contour_flow(ViewU8x1 cur, ViewU8x1 cur_visible, ViewU8x1 prev,
                                              ViewU8x1 prev_visible);

}  // namespace weft
