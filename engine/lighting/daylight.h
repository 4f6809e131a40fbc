#pragma once
// Sun and sky: how the colour of a shot's light goes with its strength.

#include "engine/core/image.h"

namespace weft {

/// From sky to sun, in ln R/G and ln B/G of linear sRGB (unit vector): daylight of 2,500 K to
/// 6,500 K over a sky of 7,000 K to 20,000 K. Nearly the same at all times of the day.
constexpr float kDaylightRed = 0.559f, kDaylightBlue = -0.829f;

/// How a surface's colours go with its light: energies of wide differences, and their product.
struct DaylightEvidence {
    double light = 0, both = 0, colour = 0;
};

/// Where the sun does not reach, the sky still does, and it is bluer.
struct Daylight {
    float slope = 0;       ///< ln chromaticity along that direction for each unit of ln luma.
    float confidence = 0;  ///< 0 to 1; 0: the plate shows no such light, and slope is 0.
    /// Of the surface's frames before, so that what is decided does not pop:
    /// SurfaceSample::evidence of the last one.
    DaylightEvidence before = {};
};

/// `linear`: a whole plate in linear light, H×W×3; NaN and infinity are ignored. Blocks of the
/// picture vote with the slope of their colours on their lightness, if that explains them: edges of
/// shadows agree all over the shot, and edges of paint do not. Thread-safe, and bit-identical for
/// any number of threads.
[[nodiscard]] Daylight find_daylight(ViewF3 linear);

}  // namespace weft
