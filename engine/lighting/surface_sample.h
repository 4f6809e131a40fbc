#pragma once
// The plate as the estimate of light sees it: small, logarithmic, and only what lies inside the
// matte.

#include "engine/core/image.h"

namespace weft {

/// Planes of one size, each H×W of the small picture's part `box`.
struct SurfaceSample {
    Recti box;           ///< Where the planes lie in the small picture; empty for an empty matte.
    ImageF1 weight;      ///< Trust in [0, 1]; 0 where nothing of the surface is seen.
    ImageF1 luma;        ///< ln(Y + floor); 0 where weight is 0.
    ImageF1 paint;       ///< What of luma the surface's own colour explains; empty: nothing.
    ImageF1 red_green;   ///< ln((R + floor) / (G + floor)): near black it turns neutral.
    ImageF1 blue_green;  ///< ln((B + floor) / (G + floor)).
    float floor = 0;     ///< Keeps black from weighing more than it should; linear light.
    int downscale = 1;   ///< Plate pixels a side of one pixel here.
    Size full;           ///< Size of the plate.
};

/// Size of the small picture.
inline Size reduced_size(Size full, int downscale) {
    return {(full.width + downscale - 1) / downscale, (full.height + downscale - 1) / downscale};
}

/// Averages `linear` in blocks of downscale × downscale over pixels whose `visible` is at least
/// 128. Pixels at the matte's rim, which other objects' light has mixed into, count little.
[[nodiscard]] SurfaceSample sample_surface(ViewF3 linear, ViewU8x1 visible, int downscale);

}  // namespace weft
