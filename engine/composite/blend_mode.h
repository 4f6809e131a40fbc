#pragma once
// How a layer goes over what is below it.

#include "engine/core/image.h"

namespace weft {

/// The blend modes of compositors, b below and t the layer. Multiply, screen and color work on
/// linear light; overlay and soft light, whose middle is a grey of 0.5, on values under the sRGB
/// curve, as in paint programs.
enum class BlendMode {
    kNormal,     ///< t
    kMultiply,   ///< b t
    kScreen,     ///< b + t − b t where one of both is at most 1, otherwise the greater one.
    kOverlay,    ///< 2 b t where b < ½, otherwise 1 − 2 (1 − b) (1 − t).
    kSoftLight,  ///< (1 − 2 t) b² + 2 t b (Pegtop's form, which has no jump of the slope).
    kColor       ///< t scaled to the luminance of b.
};

/// Replaces the layer by what is seen of it: b + opacity (mode(b, t) − b). Both H×W×3, linear
/// light; `opacity` 0 to 1. Normal at opacity 1 changes no bit. Where `below` is NaN or infinite,
/// and where `matte` is 0, the layer stays. Thread-safe.
void blend_layer(ImageView<float, 3> layer, ViewF3 below, ViewU8x1 matte, BlendMode mode,
                 float opacity);

}  // namespace weft
