#pragma once
// What a texture takes from the plate besides its shading: statistics (the baselines), the colour
// of light, and the old surface's highlights. All in linear light.

#include <array>

#include "engine/core/image.h"
#include "engine/lighting/shading.h"

namespace weft {

/// Baselines. Transfers the mean and deviation of the old surface's luma (sRGB curve) to the
/// texture (after Reinhard et al. 2001), or its whole histogram. Hue and saturation stay.
/// Statistics come from pixels whose matte is at least 128. λ = `strength` (0–1) blends with the
/// unchanged texture. All H×W.
void transfer_statistics(ImageView<float, 3> texture, ViewF3 plate, ViewU8x1 matte, float strength);
void match_histogram(ImageView<float, 3> texture, ViewF3 plate, ViewU8x1 matte, float strength);

/// How the colour of light changes with its strength inside a matte: the slopes of ln(R/Y),
/// ln(G/Y), ln(B/Y) of the plate over ln S, and their means. The old texture's own colours do not
/// follow S, so they do not affect the slope.
struct LightColour {
    std::array<float, 3> slope{};
    std::array<float, 3> mean{};
    bool known = false;
};
/// That of sun and sky, as far as the shot shows them; not known at a confidence of 0.
[[nodiscard]] LightColour daylight_colour(const Daylight& daylight);
/// `plate` and `matte` of the plate's size.
[[nodiscard]] LightColour light_colour(ViewF3 plate, ViewU8x1 matte, const Shading& shading);

/// Gives the texture the light's colour at each pixel, relative to the light on the reference frame
/// (`reference_colour`, S₀). The luminance of a grey is kept.
void apply_cast(ImageView<float, 3> texture, Vec2i origin, ViewU8x1 matte, const Shading& shading,
                float reference, const LightColour& colour, const LightColour& reference_colour,
                float strength);

}  // namespace weft
