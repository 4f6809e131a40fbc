#pragma once
// Colours of the surface and of its surroundings near a pixel, from pixels that belong wholly to
// one or the other.

#include <array>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// Sums over pixels: weight, colour, squared colour; padded to eight floats for SIMD.
struct ColourSums {
    std::array<float, 8> v{};
    [[nodiscard]] float weight() const { return v[0]; }
    [[nodiscard]] float mean(int c) const { return v[static_cast<std::size_t>(1 + c)] / v[0]; }
    /// Weighted variance, ≥ 0.
    [[nodiscard]] float variance(int c) const {
        const float m = mean(c);
        const float var = v[static_cast<std::size_t>(4 + c)] / v[0] - m * m;
        return var > 0 ? var : 0.0f;
    }
};

/// Both sides of the matte near one pixel. Weight 0: none in the whole box.
struct NearColours {
    ColourSums surface;       ///< Where the matte is 255.
    ColourSums surroundings;  ///< Where it is 0.
};

/// Pyramid of sums over blocks of 2, 4, 8 … pixels. The constructor runs in parallel; const access
/// is thread-safe.
class ColourPyramid {
  public:
    /// `box` bounds the pixels that are used, in plate pixels.
    ColourPyramid(ViewF3 plate, ViewU8x1 matte, const Recti& box);

    /// Sums around the centre of pixel (x, y). The weight falls to a quarter at twice the distance.
    [[nodiscard]] NearColours near(int x, int y) const;

  private:
    struct Level {
        int width = 0, height = 0;
        std::vector<NearColours> cells;
    };
    void build_first(ViewF3 plate, ViewU8x1 matte);
    void build_next();

    Recti box_;
    std::vector<Level> levels_;
};

}  // namespace weft
