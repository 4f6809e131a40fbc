#pragma once
// What the search kernels share. Pixels are 32-bit words: red, green and blue in the low bytes and,
// on a canvas, 1 in the highest where the pixel is compared.

#include "gpu/kernels/portable.h"

namespace weft::kernels {

constexpr u32 kColour = 0x00ffffffu;
constexpr u32 kTakesPart = 0x01000000u;

struct Cost {
    u64 ssd, weight;
};

/// One picture (the canvas, or the guide) against the window of one sample.
struct SearchArgs {
    const u32* canvas;
    int canvas_w, canvas_h;
    int torus;
    int block_x, block_y, block_w, block_h;  ///< On the canvas; may reach over its borders.
    const u32* sample;                       ///< The window's first pixel; unused bytes are 0.
    int sample_pitch;
    const u32*
        squares;  ///< At the window's first pixel: per row, sums of squares before each pixel.
    int squares_pitch;
    int window_w, window_h;
    int lo_x, lo_y, count_x, count_y;  ///< Translations.
    u32 weight;
    Cost* costs;  ///< [count_y][count_x], zeroed before the first picture.
};

/// The canvas word that block pixel (x, y) shows; 0 where there is none.
WEFT_HD u32 block_pixel(const SearchArgs& a, int x, int y) {
    if (x >= a.block_w || y >= a.block_h) return 0;
    int cx = a.block_x + x, cy = a.block_y + y;
    if (a.torus) {
        if (cx < 0) cx += a.canvas_w;
        if (cy < 0) cy += a.canvas_h;
        if (cx >= a.canvas_w) cx -= a.canvas_w;
        if (cy >= a.canvas_h) cy -= a.canvas_h;
    } else if (cx < 0 || cy < 0 || cx >= a.canvas_w || cy >= a.canvas_h) {
        return 0;
    }
    const u32 word =
        a.canvas[static_cast<u64>(cy) * static_cast<u64>(a.canvas_w) + static_cast<u64>(cx)];
    return word & kTakesPart ? word : 0;
}

/// Whether the window has the pixel (x, y).
WEFT_HD bool in_window(const SearchArgs& a, int x, int y) {
    return x >= 0 && y >= 0 && x < a.window_w && y < a.window_h;
}

WEFT_HD u32 window_pixel(const SearchArgs& a, int x, int y) {
    return a.sample[static_cast<u64>(y) * static_cast<u64>(a.sample_pitch) + static_cast<u64>(x)];
}

WEFT_HD u32 squared_distance(u32 a, u32 b) {
    const u32 d = byte_distances(a & kColour, b);
    return dot_bytes(d, d, 0);
}

}  // namespace weft::kernels
