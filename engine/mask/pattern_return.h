#pragma once
// Internal to surface_return: whether a frame shows a pattern where it is expected.

#include <optional>

#include "engine/core/image.h"

namespace weft {

/// One place in two pictures, lumas of 0 to 255.
struct PatternPair {
    ImageF1 key, now;  ///< What is expected there, and what the frame shows.
    ImageF1 known;     ///< 1 where `key` is known, else 0.
    ImageF1 wanted;    ///< 1 where it is asked for.
};

/// Where a pattern that may be anywhere lies in a picture: the shift of `key`'s places, whole
/// pixels, under which `key` where `known` is 1, or its left or right half, correlates best with
/// `picture` (0.7 at least, and 0.12 more than anywhere else). Lumas and pictures of one size.
/// Empty if there is no such place, or the pattern is plain or small. Pure; deterministic.
[[nodiscard]] std::optional<Vec2i> find_anywhere(const ImageF1& key, const ImageF1& known,
                                                 const ImageF1& picture);

/// The shift under which most of the wanted places correlate by more than 0.65, less their local
/// means, in windows of (2 radius + 1)² pixels: what is at p in `key` is at p + shift in `now`.
/// Searched from `halvings` halvings of the size, ± 4 pixels there, to the whole. Empty if fewer
/// than `least_px` pixels agree. Pure; deterministic.
[[nodiscard]] std::optional<Vec2i> find_shift(PatternPair pair, int radius, int halvings,
                                              double least_px);

/// 255 where what is wanted is found again, else 0: pieces of `least_px` pixels and more in which
/// most places agree, and which correlate by 0.8 as a whole. Pure; deterministic.
[[nodiscard]] Matte found_again(const PatternPair& pair, int radius, double least_px);

}  // namespace weft
