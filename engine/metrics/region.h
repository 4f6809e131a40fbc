#pragma once
// Luma, and the pixels that a measurement uses.

#include <cstdint>

#include "engine/core/image.h"

namespace weft {

/// A pixel counts as inside a matte from this coverage on.
inline constexpr int kInsideCoverage = 250;

/// Luma of encoded RGB in 8-bit units: 255 (0.299 R + 0.587 G + 0.114 B) (Rec. 601), not rounded.
/// `encoded` has 1.0 for white. NaN and infinity come out as they are.
[[nodiscard]] ImageF1 luma_8bit(ViewF3 encoded);

/// 255 where `matte` ≥ kInsideCoverage in the whole square of (2·radius + 1)² pixels around, else
/// 0. Pixels beyond the picture count as inside, so that a region is not eroded where the picture
/// cuts it.
[[nodiscard]] Matte eroded_inside(ViewU8x1 matte, int radius_px);

/// 255 where `matte` is above 255 − kInsideCoverage anywhere in the square of (2·radius + 1)²
/// pixels around, else 0.
[[nodiscard]] Matte grown_cover(ViewU8x1 matte, int radius_px);

/// 255 where both are 255, else 0. Both of one size.
[[nodiscard]] Matte both_inside(ViewU8x1 a, ViewU8x1 b);

/// 255 where `mask` is inside (≥ kInsideCoverage) and `luma` is a finite number, else 0.
[[nodiscard]] Matte inside_and_finite(ViewU8x1 mask, ViewF1 luma);

/// Number of pixels that are not 0.
[[nodiscard]] std::int64_t count_set(ViewU8x1 mask);

/// Σ and number over rows, added in a fixed order: rows first, each from left to right.
struct RowSum {
    double sum = 0;
    double sum_squared = 0;
    std::int64_t count = 0;
    void add(double v) {
        sum += v;
        sum_squared += v * v;
        ++count;
    }
    void add(const RowSum& o) {
        sum += o.sum;
        sum_squared += o.sum_squared;
        count += o.count;
    }
    [[nodiscard]] double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0.0; }
};

}  // namespace weft
