#pragma once
// Internal: dense inverse search (Kroeger et al. 2016, "Fast Optical Flow using Dense Inverse
// Search") on one level of a pyramid: overlapping patches, each aligned by inverse-compositional
// Gauss–Newton, and the dense motion that they vote for.

#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// One level of a pyramid of 8-bit luma, as floats without rounding, with a border of repeated
/// pixels on each side. Immutable.
class SearchPicture {
  public:
    static constexpr int kBorder = 24;

    explicit SearchPicture(ViewU8x1 luma);
    /// Half the size, rounded up: means of 2×2 pixels.
    [[nodiscard]] SearchPicture halved() const;

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] std::ptrdiff_t stride() const { return pixels_.stride(); }
    /// The pixel at (x, y), each from −kBorder to the size + kBorder − 1.
    [[nodiscard]] const float* at(int x, int y) const {
        return pixels_.pixel(x + kBorder, y + kBorder);
    }

  private:
    explicit SearchPicture(Size size);
    void repeat_border();

    Size size_;
    ImageF1 pixels_;
};

/// The levels 0 (full size) to the coarsest on which a patch still fits twice.
[[nodiscard]] std::vector<SearchPicture> search_pyramid(ViewU8x1 luma);

/// Motion of `source`'s pixels to `target`, px of this level. `coarser`: of the level of half the
/// size, in its pixels; empty on the coarsest. `iterations`: the most Gauss–Newton steps of a
/// patch. Pure; the same bits for any number of threads and every instruction set.
[[nodiscard]] ImageF2 search_level(const SearchPicture& source, const SearchPicture& target,
                                   const ImageF2& coarser, int iterations);

}  // namespace weft
