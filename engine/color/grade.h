#pragma once
// Colour correction in the terms of compositors.

#include <array>

#include "engine/core/image.h"

namespace weft {

/// Applied in this order: multiply × 2^exposure × temperature, contrast, gamma, saturation and hue,
/// offset. Results below 0 become 0.
struct Grade {
    float exposure = 0;     ///< Stops.
    float temperature = 0;  ///< Mired; above 0 is warmer. Luminance of a grey is kept.
    std::array<float, 3> multiply{1, 1, 1};
    float contrast = 1;  ///< Exponent about middle grey, 0.18.
    float gamma = 1;     ///< v^(1 / gamma)
    float saturation = 1;
    float hue_deg = 0;  ///< Turned about the grey axis; luminance is kept.
    std::array<float, 3> offset{0, 0, 0};
    bool operator==(const Grade&) const = default;
};

/// The factor on R, G and B that a shift of the colour temperature gives.
[[nodiscard]] std::array<float, 3> temperature_gain(float mired);

/// Grades `picture` (linear light, H×W×3, in place) where `matte` is above 0. A default grade
/// changes no bit; pixels that are not finite stay. Thread-safe.
void apply_grade(ImageView<float, 3> picture, ViewU8x1 matte, const Grade& grade);

}  // namespace weft
