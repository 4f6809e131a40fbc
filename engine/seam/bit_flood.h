#pragma once
// Reachability on a grid of pixels, 64 pixels at a time.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// One bit for each pixel, rows of whole words.
class BitRows {
  public:
    explicit BitRows(Size size)
        : words_((static_cast<std::size_t>(size.width) + 63) / 64),
          bits_(words_ * static_cast<std::size_t>(size.height), 0) {}
    [[nodiscard]] std::size_t words() const { return words_; }
    [[nodiscard]] std::uint64_t* row(int y) {
        return bits_.data() + static_cast<std::size_t>(y) * words_;
    }
    [[nodiscard]] const std::uint64_t* row(int y) const {
        return bits_.data() + static_cast<std::size_t>(y) * words_;
    }

  private:
    std::size_t words_;
    std::vector<std::uint64_t> bits_;
};

/// The pixels from which a step leads to the neighbour on each side.
struct FloodSteps {
    explicit FloodSteps(Size s) : size(s), right(s), left(s), down(s), up(s) {}
    Size size;
    BitRows right, left, down, up;
};

/// Adds to `reached` all pixels that its pixels lead to.
void flood(const FloodSteps& steps, BitRows& reached);

}  // namespace weft
