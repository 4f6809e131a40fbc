#pragma once
// The colour of a whole frame's light, such as an evening sun's.

#include <array>

#include "engine/core/image.h"

namespace weft {

/// ln of the gain in R, G and B that the plate's light gives a grey surface at luminance 1; each
/// within ±1. 0 if nothing shows that the light is coloured, as on a plate balanced for white.
/// `plate`: H×W×3, linear light. All functions of this header are thread-safe.
///
/// The amount is by shades of grey (Finlayson & Trezzi 2004, p = 6). The light counts as orange
/// under two conditions. First, 99 % of the brighter half of the pixels are orange: paint has all
/// colours. Second, some darker pixels are neutral or blue, because the sky lights the shade;
/// otherwise the picture may show one orange material. The same holds with blue and orange
/// exchanged.
[[nodiscard]] std::array<float, 3> plate_tint(ViewF3 plate);

/// The most probable colour of the plate's light, as plate_tint() gives it, under the second
/// condition only, and shrunk towards white, because most cameras are balanced. Unlike the first
/// condition it hardly differs between the frames of a shot.
[[nodiscard]] std::array<float, 3> likely_tint(ViewF3 plate);

/// Colours the texture (linear light, in place) by `strength` × `tint`. The luminance of a grey is
/// kept. A strength or a tint of 0 changes no bit. Pixels whose matte is 0 may be left as they are.
void apply_tint(ImageView<float, 3> texture, ViewU8x1 matte, const std::array<float, 3>& tint,
                float strength);

}  // namespace weft
