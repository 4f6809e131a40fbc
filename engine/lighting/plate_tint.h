#pragma once
// The colour that the light of a whole frame has: an evening sun on everything there is.

#include <array>

#include "engine/core/image.h"

namespace weft {

/// ln of the gain in R, G and B that a grey surface under the plate's light shows, its luminance 1;
/// 0 where nothing says that the light has a colour, as on a plate that is balanced for white.
/// `plate`: linear light. Each of them within ±1. Thread-safe, as is all in this header.
///
/// How much: the shades of grey of Finlayson & Trezzi 2004 (p = 6). Whether: paint has all colours,
/// so where even the bluest hundredth of the brighter half of the pixels is orange, it is the light
/// that may be. But it may also be a picture of one orange material; in an evening the sky lights
/// what is in shade, so that some of the darker pixels are neutral or blue. (Or all of this with
/// blue and orange exchanged.)
[[nodiscard]] std::array<float, 3> plate_tint(ViewF3 plate);

/// Colours the texture (linear light, in place) by `strength` times a tint; the luminance of a grey
/// stays. A strength or a tint of 0 changes no bit; pixels whose matte is 0 may stay as they are.
void apply_tint(ImageView<float, 3> texture, ViewU8x1 matte, const std::array<float, 3>& tint,
                float strength);

}  // namespace weft
