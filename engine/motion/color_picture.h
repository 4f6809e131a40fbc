#pragma once
// A surface's paint as one number a pixel, whatever the light: motion from colour (Golland &
// Bruckstein 1997, "Motion from Color").

#include <optional>

#include "engine/core/image.h"

namespace weft {

/// The axis along which a surface's paints differ most in the logarithm of the ratios of R, G and
/// B, which light of one colour does not change, and the paints' mean on it.
struct ColorAxis {
    Vec3 direction{0};  ///< Of unit length, orthogonal to (1, 1, 1).
    float middle = 0;
};

/// `display`: sRGB codes, H×W; `visible`: H×W, inside from 128 on. Nothing if the surface shows
/// hardly any differences of colour. Pure; deterministic.
[[nodiscard]] std::optional<ColorAxis> color_axis(ViewU8x3 display, ViewU8x1 visible);

/// The colours on the axis as a picture of 8 bit, H×W; 128 is the middle, and one level a change of
/// ratios by about a hundredth. Pure; deterministic.
[[nodiscard]] Matte color_picture(ViewU8x3 display, const ColorAxis& axis);

}  // namespace weft
