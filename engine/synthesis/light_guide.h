#pragma once
// An illumination picture as a guide for placement and cut (the paper, 2.4).

#include "engine/core/image.h"

namespace weft {

/// A picture for PlaneGuide::target: the sample's mean colour at the requested brightness. `wanted`
/// is V (max of R, G, B) in 8 bits, of the plane's size. It is scaled so that its mean over the
/// plane is the mean colour's V, because a sample cannot get brighter than it is, and smoothed (σ
/// 12 px), because fine detail of a picture is not light. Pure.
[[nodiscard]] ImageU8x3 light_guide(ViewU8x3 sample, ViewU8x1 wanted);

}  // namespace weft
