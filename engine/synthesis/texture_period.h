#pragma once
// Whether a sample repeats by itself: courses of bricks, tiles, a weave.

#include <array>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// The lattice of translations that bring a texture onto itself. Without steps it has none.
struct TexturePeriod {
    int count = 0;                 ///< Steps in use: 0, 1 (rows, planks) or 2.
    std::array<Vec2i, 2> steps{};  ///< In pixels, not collinear, the shorter first.
    /// Mean squared difference of the sample and itself moved by the first step, over that of
    /// unrelated pixels: 0 repeats exactly, 1 not at all.
    double mismatch = 1;

    /// Whether a translation is within `tolerance_px` of one of the lattice; with a single step
    /// only what lies along that step counts.
    [[nodiscard]] bool holds(Vec2i d, double tolerance_px) const;
    /// One byte for each of the translations first + (x, y): 1 where it holds.
    [[nodiscard]] Image<std::uint8_t, 1> held(Vec2i first, Size size, double tolerance_px) const;
    /// The shortest steps of the lattice along each axis, 0 where there is none.
    [[nodiscard]] Size axis_px() const;
};

/// Looks for steps of at least 8 px and at most half the sample (of a large one, of its middle 256
/// px). Thread-safe.
[[nodiscard]] TexturePeriod find_period(ViewU8x3 sample);

}  // namespace weft
