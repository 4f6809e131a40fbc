#pragma once
// Detects whether a sample is periodic: courses of bricks, tiles, a weave.

#include <array>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// The lattice of translations that map a texture onto itself; none without steps.
struct TexturePeriod {
    int count = 0;                 ///< Steps in use: 0, 1 (rows, planks) or 2.
    std::array<Vec2i, 2> steps{};  ///< In pixels, not collinear, the shorter first.
    /// Mean squared difference of the sample and itself moved by the first step, over that of
    /// unrelated pixels: 0 repeats exactly, 1 does not repeat.
    double mismatch = 1;

    /// True if a translation is within `tolerance_px` of a lattice point; with a single step only
    /// the part along that step counts.
    [[nodiscard]] bool holds(Vec2i d, double tolerance_px) const;
    /// One byte for each of the translations first + (x, y): 1 where holds() is true.
    [[nodiscard]] Image<std::uint8_t, 1> held(Vec2i first, Size size, double tolerance_px) const;
    /// The shortest lattice steps along each axis, in pixels; 0 if there is none.
    [[nodiscard]] Size axis_px() const;
};

/// How the sample (of a large one its middle 256 px) differs from itself moved by d, for
/// |d.x| ≤ reach.x and 0 ≤ d.y ≤ reach.y, at (d.x + reach.x, d.y): the mean squared difference over
/// that of unrelated pixels.
struct SelfMismatch {
    Image<double, 1> mismatch;
    Vec2i reach{0, 0};
};
[[nodiscard]] SelfMismatch self_mismatch(ViewU8x3 sample);

/// Searches steps of at least 8 px and at most half the sample (of a large one, its middle 256 px).
/// Thread-safe.
[[nodiscard]] TexturePeriod find_period(ViewU8x3 sample);
[[nodiscard]] TexturePeriod find_period(const SelfMismatch& self);

}  // namespace weft
