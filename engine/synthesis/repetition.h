#pragma once
// How visibly a plane repeats.

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

struct Repetition {
    /// The highest peak of the normalised autocorrelation of the plane's luma, except at the origin
    /// and at the texture's own period: 0 no repetition, 1 exact; and its position in pixels.
    double peak = 0;
    Vec2i peak_at{0, 0};
    /// The value at the texture's own period; 0 if it has none.
    double own_period = 0;
    /// The largest share of texels that show the same sample pixel as the texel one step away; and
    /// that step in pixels.
    double verbatim = 0;
    Vec2i verbatim_at{0, 0};
};

/// Uses the middle of the plane, up to 768 px, and steps of 12 px up to half of that. Pure.
[[nodiscard]] Repetition measure_repetition(const TexturePlane& plane);

/// Only `peak` and `own_period`, of any picture.
[[nodiscard]] Repetition measure_repetition(ViewU8x3 picture, const TexturePeriod& period);

}  // namespace weft
