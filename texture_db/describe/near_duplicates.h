#pragma once
// Internal: detects pictures that were added before, also if scaled or recompressed.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// Stores a small thumbnail of every picture. Not thread-safe.
class NearDuplicates {
  public:
    /// False if a similar picture was added before: thumbnails of 16×16 correlate above 0.965 in
    /// lightness and their mean colours are within 7 levels per channel.
    bool add_if_new(ViewU8x3 picture);
    [[nodiscard]] bool is_known(ViewU8x3 picture) const;
    [[nodiscard]] std::size_t size() const { return marks_.size(); }

  private:
    static constexpr std::size_t kCells = 256;
    struct Mark {
        std::array<float, 3> mean{};
        std::array<std::int8_t, kCells> shape{};  ///< Lightness against its mean.
        float norm = 0;
    };
    [[nodiscard]] static Mark mark_of(ViewU8x3 picture);
    [[nodiscard]] bool known(const Mark& mark) const;
    std::vector<Mark> marks_;
};

}  // namespace weft
