#pragma once
// Where to place the sample next: the exact best translation of all that are allowed, and those
// that are nearly as good.

#include <memory>
#include <vector>

#include "engine/core/image.h"
#include "engine/synthesis/overlap_cost.h"

namespace weft {

class DirectSearch;
class FftCorrelation;

enum class SearchMethod { kFastest, kFft, kDirect };  ///< All give the same result.

/// The good placements: every translation whose cost is at most `kGoodFactor` of the best one's, in
/// index order (row by row), and the best (of equal ones the lower index).
struct Shortlist {
    std::vector<Vec2i> good;
    Vec2i best{0, 0};
    OverlapCost best_cost;
};

/// How much worse than the best a good placement may be, in mean squared difference.
inline constexpr std::uint32_t kGoodNumerator = 130, kGoodDenominator = 100;

/// Translations t ∈ [lo, hi] by index, row by row.
[[nodiscard]] inline Vec2i translation_at(Vec2i lo, Vec2i hi, std::size_t index) {
    const auto row = static_cast<std::size_t>(hi.x - lo.x + 1);
    return {lo.x + static_cast<int>(index % row), lo.y + static_cast<int>(index / row)};
}
/// One byte per translation: 0 for the forbidden ones, unless all are, else 1.
[[nodiscard]] std::vector<std::uint8_t> allowed_translations(Vec2i lo, Vec2i hi,
                                                             const std::vector<Vec2i>& forbidden);

/// Searches one sample (or a window of it) over blocks of one size, with the translations t ∈ [lo,
/// hi]; t is the position of the sample's origin in the block. Each search method prepares its data
/// at its first use. Thread-safe.
class PlacementSearch {
  public:
    PlacementSearch(ViewU8x3 sample, Size block, Vec2i lo, Vec2i hi);
    ~PlacementSearch();
    PlacementSearch(PlacementSearch&&) noexcept;

    /// `forbidden` translations are ignored, unless all are forbidden.
    [[nodiscard]] Shortlist find(const MatchTarget& target, const std::vector<Vec2i>& forbidden,
                                 SearchMethod method = SearchMethod::kFastest);

  private:
    [[nodiscard]] std::size_t count() const;
    [[nodiscard]] Vec2i translation(std::size_t index) const {
        return translation_at(lo_, hi_, index);
    }
    [[nodiscard]] Shortlist find_direct(const MatchTarget& target,
                                        const std::vector<std::uint8_t>& allowed);
    [[nodiscard]] Shortlist find_fft(const MatchTarget& target,
                                     const std::vector<std::uint8_t>& allowed);
    [[nodiscard]] bool direct_is_faster(const MatchTarget& target,
                                        const std::vector<std::uint8_t>& allowed) const;

    ViewU8x3 sample_;
    Size block_;
    Vec2i lo_, hi_;
    struct Once;
    std::unique_ptr<Once> once_;
    std::unique_ptr<DirectSearch> direct_;
    std::unique_ptr<FftCorrelation> fft_;
};

}  // namespace weft
