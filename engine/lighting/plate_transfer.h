#pragma once
// What a texture takes from the plate besides its shading: statistics (the baselines), the colour
// of light, and the old surface's highlights. All in linear light.

#include <array>

#include "engine/core/image.h"
#include "engine/lighting/shading.h"

namespace weft {

/// Mean and deviation of the old surface's luma (sRGB curve) onto the texture's (after Reinhard et
/// al. 2001), or its whole histogram; hue and saturation stay. From pixels whose matte is at least
/// 128; all of one size. λ = `strength` mixes with the texture as it was. The baselines.
void transfer_statistics(ImageView<float, 3> texture, ViewF3 plate, ViewU8x1 matte, float strength);
void match_histogram(ImageView<float, 3> texture, ViewF3 plate, ViewU8x1 matte, float strength);

/// How the colour of light changes with its strength inside of a matte: the slope of ln(R/Y),
/// ln(G/Y), ln(B/Y) of the plate against ln S, and the means of them. The old texture's own colours
/// do not follow S, so they do not enter the slope.
struct LightColour {
    std::array<float, 3> slope{};
    std::array<float, 3> mean{};
    bool known = false;
};
/// `plate` and `matte` of the plate's size.
[[nodiscard]] LightColour light_colour(ViewF3 plate, ViewU8x1 matte, const Shading& shading);

/// Colours the texture as the light is coloured there, relative to the light on the reference frame
/// (`reference_colour`, S₀), without changing what a grey's luminance would be.
void apply_cast(ImageView<float, 3> texture, Vec2i origin, ViewU8x1 matte, const Shading& shading,
                float reference, const LightColour& colour, const LightColour& reference_colour,
                float strength);

/// Adds `strength` times what the plate is brighter than the brightest paint under its shading: the
/// old surface's gloss. `plate` and `matte` are of the texture's size.
void add_highlights(ImageView<float, 3> texture, Vec2i origin, ViewF3 plate, ViewU8x1 matte,
                    const Shading& shading, float strength);

}  // namespace weft
