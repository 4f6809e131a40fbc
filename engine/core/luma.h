#pragma once
// Brightness of a colour as a weighted sum of R, G and B.

namespace weft {

/// Weights of Rec. ITU-R BT.709-6, 3.2: the luminance Y of linear light in sRGB's primaries, the
/// luma Y' of encoded values.
template <typename T>
[[nodiscard]] constexpr T luma_709(T r, T g, T b) {
    return T(0.2126) * r + T(0.7152) * g + T(0.0722) * b;
}
/// Of three values in a row: R, G, B.
[[nodiscard]] constexpr float luma_709(const float* rgb) {
    return luma_709(rgb[0], rgb[1], rgb[2]);
}

/// Luma code of 8-bit codes with the weights of BT.709 in 15 bits, rounded: integers alone, so that
/// motion, mattes and seams see the same picture on every machine.
[[nodiscard]] constexpr int luma_709_code(int r, int g, int b) {
    return (r * 6966 + g * 23436 + b * 2366 + 16384) >> 15;
}

/// Weights of Rec. ITU-R BT.601-7, 2.5.1: the luma of encoded values that grain, matching of blocks
/// and measuring work on.
template <typename T>
[[nodiscard]] constexpr T luma_601(T r, T g, T b) {
    return T(0.299) * r + T(0.587) * g + T(0.114) * b;
}
[[nodiscard]] constexpr float luma_601(const float* rgb) {
    return luma_601(rgb[0], rgb[1], rgb[2]);
}

}  // namespace weft
