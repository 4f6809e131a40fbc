#pragma once
// A print of a few paints, as on a checked shirt: colours, not light, make it light and dark.

#include <vector>

#include "engine/core/image.h"

namespace weft {

struct SurfaceSample;

/// One paint of a print, in the units of SurfaceSample.
struct PrintPaint {
    float luma = 0, red_green = 0, blue_green = 0;
};

struct SurfacePrint {
    std::vector<PrintPaint> paints;  ///< Empty if confidence is 0.
    float confidence = 0;            ///< That the surface is printed all over, 0 to 1.
    float tile_px = 0;               ///< Side of a part that shows several paints, small pixels.
    float mean_luma = 0;             ///< Of the paints, weighted by their areas.
    float median_luma = 0;           ///< Of the surface, where the print was found.
};

/// Looks for a print. Light makes a paint darker and hardly changes its chromaticity, so that on
/// cloth of one paint, and on a pile or hair that shifts in colour with its lightness, places of
/// one lightness have one colour. A print has places as light as each other that differ in colour,
/// and it has them in nearly every part of the surface. A figure that is made of several things has
/// too few such parts. `sample.box` must not be empty. Thread-safe; the result does not depend on
/// the number of threads.
[[nodiscard]] SurfacePrint find_print(const SurfaceSample& sample);

struct PrintedPaint {
    ImageF1 luma;    ///< ln luma of the paint, less the print's mean; 0 where unknown.
    ImageF1 weight;  ///< The sample's; little where the paint beside is another one.
};

/// The paint at each place of a sample, H×W of its box. Paint and a smooth shade are told in turn,
/// since a paint in shade is as dark as another (k-means with a bias field, Ahmed et al. 2002, on
/// colours). The print must have paints. Thread-safe; the result does not depend on the number of
/// threads.
[[nodiscard]] PrintedPaint printed_paint(const SurfaceSample& sample, const SurfacePrint& print);

}  // namespace weft
