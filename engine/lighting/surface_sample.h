#pragma once
// The plate as the shading estimate sees it: downscaled, logarithmic, and only inside the matte.

#include "engine/core/image.h"
#include "engine/lighting/daylight.h"
#include "engine/lighting/surface_print.h"

namespace weft {

/// Planes of one size, each H×W of the small picture's part `box`.
struct SurfaceSample {
    Recti box;           ///< Where the planes lie in the small picture; empty for an empty matte.
    ImageF1 weight;      ///< Confidence, 0 to 1; 0 where the surface is not visible.
    ImageF1 luma;        ///< ln(Y + floor); 0 where weight is 0.
    ImageF1 paint;       ///< The part of luma that the surface's own colour explains; empty: none.
    ImageF1 daylight;    ///< The part of luma that is light, by its colour; empty: none.
    ImageF1 red_green;   ///< ln((R + floor) / (G + floor)): near black it turns neutral.
    ImageF1 blue_green;  ///< ln((B + floor) / (G + floor)).
    DaylightEvidence evidence = {};  ///< Of this frame and, ever less, of those before.
    SurfacePrint print = {};  ///< By which paint was told; of a stored sample its confidence.
    float floor = 0;          ///< Added before the logarithm: damps black; linear light.
    int downscale = 1;        ///< Side of one pixel here, in plate pixels.
    Size full;                ///< Size of the plate.
};

/// Size of the small picture.
inline Size reduced_size(Size full, int downscale) {
    return {(full.width + downscale - 1) / downscale, (full.height + downscale - 1) / downscale};
}

/// Averages `linear` in blocks of downscale × downscale over pixels whose `visible` is at least
/// 128. Pixels at the matte's rim count little, because light of other objects is mixed into them.
[[nodiscard]] SurfaceSample sample_surface(ViewF3 linear, ViewU8x1 visible, int downscale);

/// Its luma without the light that colours tell.
[[nodiscard]] ImageF1 painted_luma(const SurfaceSample& sample);
/// Its luma without the light and the paint that colours tell.
[[nodiscard]] ImageF1 undecided_luma(const SurfaceSample& sample);

}  // namespace weft
