#pragma once
// Internal: the camera's orientation by EXIF and TIFF.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

/// The Orientation tag (0x0112 of TIFF 6.0 and Exif 2.3): 1 is upright, 2 to 4 are mirrored or
/// upside down, 5 to 8 lie on their side, which swaps width and height.
inline bool lies_on_its_side(int orientation) {
    return orientation >= 5 && orientation <= 8;
}

/// The tag's value in an Exif block (which begins with a TIFF header); 1 if there is none.
[[nodiscard]] int orientation_of_exif(const unsigned char* exif, std::size_t bytes);

/// The size after rotation.
[[nodiscard]] inline Size upright(Size stored, int orientation) {
    return lies_on_its_side(orientation) ? Size{stored.height, stored.width} : stored;
}

/// Interleaved samples of a picture of size `stored`, rotated upright. Values other than 2 to 8
/// leave them unchanged.
template <class T>
[[nodiscard]] std::vector<T> upright(std::vector<T> samples, Size stored, int channels,
                                     int orientation) {
    if (orientation < 2 || orientation > 8) return samples;
    const Size size = upright(stored, orientation);
    const auto count = static_cast<std::size_t>(channels);
    std::vector<T> out(samples.size());
    T* to = out.data();
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x, to += count) {
            // Where the pixel lies in the file: rows and columns as the tag's table names them.
            int column = lies_on_its_side(orientation) ? y : x;
            int row = lies_on_its_side(orientation) ? x : y;
            const bool from_right =
                orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
            const bool from_bottom =
                orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
            if (from_right) column = stored.width - 1 - column;
            if (from_bottom) row = stored.height - 1 - row;
            const T* from = samples.data() + (static_cast<std::size_t>(row) *
                                                  static_cast<std::size_t>(stored.width) +
                                              static_cast<std::size_t>(column)) *
                                                 count;
            for (std::size_t c = 0; c < count; ++c)
                to[c] = from[c];
        }
    }
    return out;
}

}  // namespace weft
