#pragma once
// Means and deviations of planes that are only partly known.

#include "engine/core/image.h"

namespace weft {

/// A plane under a Gaussian, where enough of it is known.
struct MaskedBlur {
    ImageF1 value;  ///< Filled from its surroundings where nothing is known.
    Matte known;    ///< 255 or 0.
};

/// `weighted_plane`: a plane × `weight`, 0 to 1; both H×W.
[[nodiscard]] MaskedBlur blurred(const ImageF1& weighted_plane, const ImageF1& weight, float sigma);

/// Median absolute difference of two planes where `weight` is above 0, scaled to a standard
/// deviation. A median is not raised by the edges of shadows, which cover few pixels. All H×W.
[[nodiscard]] float deviation_between(const ImageF1& a, const ImageF1& b, const ImageF1& weight);

}  // namespace weft
