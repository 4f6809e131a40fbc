#pragma once
#include "engine/core/image.h"

namespace weft {

/// How far each level set of a matte moves outwards, px: `all` for every one, and the lowest by
/// `low` and the highest by `high` more, those between in proportion.
struct EdgeShift {
    float all = 0, low = 0, high = 0;

    [[nodiscard]] float of(float level) const { return all + low + level * (high - low); }
    /// The farthest that any level set moves.
    [[nodiscard]] float reach() const {
        const auto size = [](float v) { return v < 0 ? -v : v; };
        const float a = size(all + low), b = size(all + high);
        return a > b ? a : b;
    }
};

/// Moves the level sets of `alpha` (0 to 1), each by its own signed distance, so that a soft edge
/// is moved as a whole and semi-transparent parts keep their value. An edge of about one pixel's
/// width is moved as a line and covered anew, so that it stays as sharp as it is. Thread-safe; the
/// same for any number of threads.
[[nodiscard]] ImageF1 shifted_edge(const ImageF1& alpha, const EdgeShift& shift);

/// Filters the outline: the signed distance of the line at one half is replaced by
/// 2 G φ − G G φ, G a Gaussian of deviation `sigma_px`. That is Tukey's "twicing": curves keep
/// their place up to the fourth order of σ, where G alone would shrink a disc of radius r by
/// σ²/(2 r). Soft edges are smoothed level set by level set.
[[nodiscard]] ImageF1 smoothed_edge(const ImageF1& alpha, float sigma_px);

}  // namespace weft
