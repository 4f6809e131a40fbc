#pragma once
// Exact integer sums over rectangles.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/core/image.h"
#include "engine/synthesis/scratch.h"

namespace weft {

class RectangleSums {
  public:
    explicit RectangleSums(Size s)
        : columns_(static_cast<std::size_t>(s.width) + 1),
          sums_(columns_ * (static_cast<std::size_t>(s.height) + 1)) {
        std::fill_n((*sums_).begin(), columns_, 0);
    }

    /// Call for all rows from the top; `value(x)` of each pixel.
    template <class Value>
    void set_row(int y, Value value) {
        std::int64_t run = 0;
        const std::int64_t* above = row(y);
        std::int64_t* out = &(*sums_)[static_cast<std::size_t>(y + 1) * columns_];
        out[0] = 0;
        for (std::size_t x = 1; x < columns_; ++x) {
            run += value(static_cast<int>(x) - 1);
            out[x] = above[x] + run;
        }
    }
    [[nodiscard]] std::int64_t sum(const Recti& r) const {
        const std::int64_t *top = row(r.y0), *bottom = row(r.y1);
        return bottom[r.x1] - bottom[r.x0] - top[r.x1] + top[r.x0];
    }

  private:
    [[nodiscard]] const std::int64_t* row(int y) const {
        return &(*sums_)[static_cast<std::size_t>(y) * columns_];
    }

    std::size_t columns_;
    Scratch<std::vector<std::int64_t>> sums_;
};

/// The set pixels of a mask as disjoint rectangles: runs, joined over equal rows.
[[nodiscard]] std::vector<Recti> rectangles_of(ViewU8x1 mask);

}  // namespace weft
