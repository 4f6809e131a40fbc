#pragma once
// The exact costs of all translations, by integer correlation.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/core/image.h"
#include "engine/synthesis/correlate_rows.h"
#include "engine/synthesis/overlap_cost.h"

namespace weft {

/// Translations that one pass of the correlation computes together: some neighbouring rows, and the
/// columns in which one of these rows has an allowed translation. Counted from 0.
struct TranslationGroup {
    int row = 0, rows = 0;
    std::vector<int> columns;
};
/// `allowed`: one byte per translation, row by row. With a period most translations are forbidden,
/// and most rows and columns need no pass.
[[nodiscard]] std::vector<TranslationGroup> group_translations(
    const std::vector<std::uint8_t>& allowed, int columns);

/// A sample prepared for direct comparison with blocks of one size, over the translations t ∈ [lo,
/// hi]. Thread-safe once constructed.
class DirectSearch {
  public:
    DirectSearch(ViewU8x3 sample, Size block, Vec2i lo, Vec2i hi);

    /// OverlapScorer::cost() of every allowed translation (1 in `allowed`), row by row, with the
    /// current instruction set; 0 for the others.
    [[nodiscard]] std::vector<OverlapCost> costs(const MatchTarget& target,
                                                 const std::vector<std::uint8_t>& allowed) const;

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
                   const std::vector<std::uint8_t>& allowed,
                   const std::vector<TranslationGroup>& groups,
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
