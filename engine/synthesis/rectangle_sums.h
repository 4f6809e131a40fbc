#pragma once
// Sums over rectangles of exact integers.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace weft {

class RectangleSums {
  public:
    explicit RectangleSums(Size s) : sums_(s.width + 1, s.height + 1, 0) {}

    /// Rows from the top; `value(x)` of each pixel.
    template <class Value>
    void set_row(int y, Value value) {
        std::int64_t run = 0;
        const std::int64_t* above = sums_.row(y);
        std::int64_t* out = sums_.row(y + 1);
        for (int x = 0; x + 1 < sums_.width(); ++x) {
            run += value(x);
            out[x + 1] = above[x + 1] + run;
        }
    }
    [[nodiscard]] std::int64_t sum(const Recti& r) const {
        const std::int64_t *top = sums_.row(r.y0), *bottom = sums_.row(r.y1);
        return bottom[r.x1] - bottom[r.x0] - top[r.x1] + top[r.x0];
    }

  private:
    Image<std::int64_t, 1> sums_;
};

/// The set pixels of a mask as disjoint rectangles: runs, joined over equal rows.
[[nodiscard]] std::vector<Recti> rectangles_of(ViewU8x1 mask);

}  // namespace weft
