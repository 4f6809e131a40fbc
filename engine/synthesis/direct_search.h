#pragma once
// The exact costs of all translations at once, by integer correlation.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/core/image.h"
#include "engine/synthesis/correlate_rows.h"
#include "engine/synthesis/overlap_cost.h"

namespace weft {

/// A sample prepared for direct comparison with blocks of one size, over the translations
/// t ∈ [lo, hi]. Thread-safe once made.
class DirectSearch {
  public:
    DirectSearch(ViewU8x3 sample, Size block, Vec2i lo, Vec2i hi);

    /// OverlapScorer::cost() of every translation, row by row, by the instruction set in force.
    [[nodiscard]] std::vector<OverlapCost> costs(const MatchTarget& target) const;

  private:
    struct Hull {
        int first = 0, last = 0;  ///< Half-open.
        [[nodiscard]] bool empty() const { return last <= first; }
        void join(Hull o) {
            if (o.empty()) return;
            first = empty() ? o.first : std::min(first, o.first);
            last = std::max(last, o.last);
        }
    };

    void add_layer(ViewU8x3 picture, ViewU8x1 mask, std::uint32_t weight,
                   std::vector<OverlapCost>& costs) const;
    void rows_of_group(const std::vector<Hull>& hulls, std::size_t stride, int first_ty, int size,
                       std::vector<CorrelationRow>& rows) const;
    [[nodiscard]] std::size_t padded_index(int x, int y) const {
        return static_cast<std::size_t>(y) * row_bytes_ + 3 * static_cast<std::size_t>(x);
    }

    Size sample_size_, block_;
    Vec2i lo_, hi_;
    std::size_t row_bytes_ = 0;
    std::vector<std::uint8_t> padded_;  ///< 0 outside of the sample.
    /// Sums of |S|² − 256 Σ S over all pixels above and to the left, on the padded grid.
    Image<std::int64_t, 1> lengths_;
};

}  // namespace weft
