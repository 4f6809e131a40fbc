#pragma once
// The exact cost of placing a sample over a block. Integers, so that every search finds one winner.

#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// What a placement is compared with: the filled pixels of a block and, with a guide, the picture
/// that the block should resemble. Weights are integers; without a guide its images are empty.
struct MatchTarget {
    ViewU8x3 pixels;
    ViewU8x1 filled;  ///< 0 or 1.
    ViewU8x3 guide;
    ViewU8x1 guide_known;  ///< 0 or 1.
    std::uint32_t fill_weight = 1, guide_weight = 0;
};

/// Weighted sum of squared differences over the three channels, and the sum of the weights. Costs
/// are compared as ssd / weight; without any weight the cost is 0.
struct OverlapCost {
    std::uint64_t ssd = 0;
    std::uint64_t weight = 0;
};

/// Whether `a` ≤ `b` · numerator / denominator, exactly; costs are fractions.
[[nodiscard]] bool at_most(const OverlapCost& a, const OverlapCost& b, std::uint32_t numerator = 1,
                           std::uint32_t denominator = 1);

/// Scores placements against one target. Thread-safe.
class OverlapScorer {
  public:
    OverlapScorer(const MatchTarget& target, ViewU8x3 sample);

    /// The cost of showing sample pixel p − t at the block's pixel p, over the block's pixels that
    /// the sample reaches. `t` in pixels.
    [[nodiscard]] OverlapCost cost(Vec2i t) const;
    /// Pixels that are compared if the sample covers the whole block.
    [[nodiscard]] std::int64_t pixels() const { return pixels_; }

  private:
    struct Run {
        int y, x0, x1;
    };
    static std::vector<Run> runs_of(ViewU8x1 mask);
    [[nodiscard]] OverlapCost sum(const std::vector<Run>& runs, ViewU8x3 picture, Vec2i t) const;

    MatchTarget target_;
    ViewU8x3 sample_;
    std::vector<Run> filled_, guided_;
    std::int64_t pixels_ = 0;
};

}  // namespace weft
