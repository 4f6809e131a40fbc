#pragma once
// How visibly a plane repeats itself.

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

struct Repetition {
    /// The highest peak of the normalised autocorrelation of the plane's luma off the origin and
    /// off the texture's own period: 0 nothing comes back, 1 everything does. And where it is.
    double peak = 0;
    Vec2i peak_at{0, 0};
    /// The same at the texture's own period; 0 where it has none.
    double own_period = 0;
    /// The largest share of texels that show the very sample pixel that the texel one step away
    /// shows. And that step.
    double verbatim = 0;
    Vec2i verbatim_at{0, 0};
};

/// Looks at the middle of the plane, up to 768 px, and at steps of 12 px up to half of that. Pure.
[[nodiscard]] Repetition measure_repetition(const TexturePlane& plane);

/// The first part alone, of any picture.
[[nodiscard]] Repetition measure_repetition(ViewU8x3 picture, const TexturePeriod& period);

}  // namespace weft
