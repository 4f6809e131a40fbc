#pragma once
// The old surface's gloss, kept on top of the new texture.

#include <array>

#include "engine/core/image.h"
#include "engine/lighting/shading.h"

namespace weft {

/// The two colours that a glossy surface of one paint shows (the dichromatic model, Shafer 1985):
/// its body's, under the light, and the light's own, which it mirrors. Both have luminance 1.
struct SurfaceColours {
    std::array<float, 3> body{1, 1, 1}, light{1, 1, 1};
    /// 0 where the surface is as colourless as its light, or of several paints: then the two cannot
    /// be told apart. 1 where they surely can.
    float confidence = 0;
};

/// Those of the surface where `matte` is at least 128, of the plate's size. The body's colour is
/// that of its most saturated tenth: gloss makes paler. `light_tint`: ln of the light's R, G and B
/// at luminance 1, as plate_tint(). `plate`: linear light; what is not finite does not count.
/// Thread-safe.
[[nodiscard]] SurfaceColours surface_colours(ViewF3 plate, ViewU8x1 matte,
                                             const std::array<float, 3>& light_tint);

struct HighlightOptions {
    float amount = 0;     ///< 0 none, 1 as on the plate, to 2.
    float roughness = 0;  ///< 0 as sharp as the plate, 1 blurred by 3 % of `plate_width`.
    int plate_width = 0;  ///< px
};

/// The old surface's gloss over a box: what is added to the lit texture, and the share of that
/// light which remains, so that nothing is lit twice.
struct Highlights {
    ImageF3 gloss;
    ImageF1 body;
};

/// What moves over the surface: moving_gloss(), and how far it is trusted; may be empty.
struct MovingGloss {
    ImageF1 luminance;
    float confidence = 0;
};

/// Finds them. As far as its colours are trusted, gloss is what of the plate has the light's colour
/// and not the body's; for the rest what moves over the surface, as far as that is trusted, and at
/// least the excess of the plate over the brightest paint under its shading. `plate`, `matte` and
/// `moving` are of one size, whose pixel (0, 0) lies at `origin`. Amount 0: empty pictures.
/// Thread-safe.
[[nodiscard]] Highlights find_highlights(Vec2i origin, ViewF3 plate, ViewU8x1 matte,
                                         const Shading& shading, const SurfaceColours& colours,
                                         const MovingGloss& moving,
                                         const HighlightOptions& options);

/// Puts them on a texture of their size; empty ones change no bit.
void add_highlights(ImageView<float, 3> texture, const Highlights& highlights);

}  // namespace weft
