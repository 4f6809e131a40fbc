#pragma once
// A small shot with known motion.

#include <cstdint>

#include "engine/core/image.h"

namespace weft::test {

/// A textured card of 80×60 that moves by (2, 1) pixels a frame before a still background.
struct Card {
    static constexpr Size kPlate{160, 120};
    static constexpr int kWidth = 80, kHeight = 60;
    static constexpr int kStepX = 2, kStepY = 1;
    static Vec2i corner(int step) { return {30 + kStepX * step, 25 + kStepY * step}; }
    static bool covers(int step, int x, int y);
};

/// The plate `step` frames after the first, codes/255 throughout.
ImageF3 card_plate(int step);
Matte card_matte(int step);
/// A colourful pattern with detail at several sizes.
ImageF3 pattern_picture(Size size, std::uint64_t seed);
/// A plane of 128x128 that repeats, in waves of `period` texels: so smooth that it does not matter
/// how it is filtered, and so steep that half a pixel shows.
ImageF3 smooth_plane(float period = 64);

}  // namespace weft::test
